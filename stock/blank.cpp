#include "stock/blank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustum::stock {
namespace {

using cutter::Ray;
using cutter::RaySpan;

// Faces of a box: 0..5 = -x +x -y +y -z +z; of a frustum: 4 bottom, 5 top, 6 mantle.
constexpr EndTag kBottom = 4;
constexpr EndTag kTop = 5;
constexpr EndTag kMantle = 6;

// Clips [lo, hi] by start + s*slope <= 0, an outward half-space seen along the ray.
void clip(Interval& chord, double start, double slope, EndTag face) {
  if (slope == 0.0) {
    if (start > 0.0) chord.hi = chord.lo;
    return;
  }
  const double s = -start / slope;
  if (slope > 0.0 && s < chord.hi) {
    chord.hi = s;
    chord.hi_tag = face;
  } else if (slope < 0.0 && s > chord.lo) {
    chord.lo = s;
    chord.lo_tag = face;
  }
}

// Clips by x^2 + y^2 <= r(z)^2, r(z) = r0 + k z >= 0 (p, d relative to the centre of the bottom).
void clip_by_mantle(Interval& chord, const FrustumShape& shape, const Vec3& p, const Vec3& d) {
  const double k = (shape.top_radius - shape.bottom_radius) / shape.height;
  const double r = shape.bottom_radius + k * p.z();
  const double a = d.x() * d.x() + d.y() * d.y() - k * k * d.z() * d.z();
  const double b = p.x() * d.x() + p.y() * d.y() - k * r * d.z();
  const double c = p.x() * p.x() + p.y() * p.y() - r * r;
  // Below 1e-15 the ray runs along the mantle within rounding, and the equation is linear.
  if (std::abs(a) < 1e-15) {
    clip(chord, c, 2.0 * b, kMantle);
    return;
  }
  const double discriminant = b * b - a * c;
  if (discriminant <= 0.0) {
    if (a > 0.0) chord.hi = chord.lo;  // a < 0: inside the double cone all along
    return;
  }
  // The roots without cancellation.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double s1 = std::min(q / a, c / q);
  const double s2 = std::max(q / a, c / q);
  if (a > 0.0) {
    if (s1 > chord.lo) chord.lo = s1, chord.lo_tag = kMantle;
    if (s2 < chord.hi) chord.hi = s2, chord.hi_tag = kMantle;
    return;
  }
  // Steeper than the mantle: inside before s1 and after s2; only one of them is on the nappe r >= 0.
  const bool keep_before = chord.lo < s1 && r + k * d.z() * (std::max(chord.lo, s1 - 1.0)) >= 0.0;
  if (keep_before) {
    if (s1 < chord.hi) chord.hi = s1, chord.hi_tag = kMantle;
  } else if (s2 > chord.lo) {
    chord.lo = s2, chord.lo_tag = kMantle;
  }
}

Diagnostic empty_blank(const char* what, double value) {
  return error(fmt::format("the blank is empty: {} is {} mm", what, value),
               "every dimension must be a finite number above 0");
}

}  // namespace

Result<Blank> Blank::make(const BlankShape& shape, const Vec3& origin) {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (!origin.allFinite()) return error("the blank's origin is not finite");
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    if (!positive(box->size_x)) return empty_blank("its size in X", box->size_x);
    if (!positive(box->size_y)) return empty_blank("its size in Y", box->size_y);
    if (!positive(box->height)) return empty_blank("its height", box->height);
  } else {
    const auto& frustum = std::get<FrustumShape>(shape);
    if (!positive(frustum.height)) return empty_blank("its height", frustum.height);
    if (!positive(frustum.bottom_radius))
      return empty_blank("its bottom radius", frustum.bottom_radius);
    if (!positive(frustum.top_radius)) return empty_blank("its top radius", frustum.top_radius);
  }
  return Blank(shape, origin);
}

IntervalSet Blank::along(const Ray& ray, RaySpan span) const {
  const Vec3 p = ray.origin - origin_;
  const Vec3& d = ray.direction;
  Interval chord{span.lo, span.hi, -1, -1};
  if (const auto* box = std::get_if<BoxShape>(&shape_)) {
    const Vec3 lo(-box->size_x / 2, -box->size_y / 2, 0.0);
    const Vec3 hi(box->size_x / 2, box->size_y / 2, box->height);
    for (int k = 0; k < 3; ++k) {
      clip(chord, lo[k] - p[k], -d[k], 2 * k);
      clip(chord, p[k] - hi[k], d[k], 2 * k + 1);
    }
  } else {
    const auto& frustum = std::get<FrustumShape>(shape_);
    clip(chord, -p.z(), -d.z(), kBottom);
    clip(chord, p.z() - frustum.height, d.z(), kTop);
    if (chord.lo < chord.hi) clip_by_mantle(chord, frustum, p, d);
  }
  return IntervalSet({chord});
}

Vec3 Blank::normal(EndTag face, const Vec3& point) const {
  if (face < kMantle) {
    const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(face / 2));
    return face % 2 == 0 ? Vec3(-axis) : axis;
  }
  const auto& frustum = std::get<FrustumShape>(shape_);
  const Vec3 across(point.x() - origin_.x(), point.y() - origin_.y(), 0.0);
  const double slope = (frustum.bottom_radius - frustum.top_radius) / frustum.height;
  return (across.normalized() + slope * Vec3::UnitZ()).normalized();
}

BoundingBox Blank::bounds() const {
  Vec3 half;
  double height = 0.0;
  if (const auto* box = std::get_if<BoxShape>(&shape_)) {
    half = Vec3(box->size_x / 2, box->size_y / 2, 0.0);
    height = box->height;
  } else {
    const auto& frustum = std::get<FrustumShape>(shape_);
    const double radius = std::max(frustum.bottom_radius, frustum.top_radius);
    half = Vec3(radius, radius, 0.0);
    height = frustum.height;
  }
  return {origin_ - half, origin_ + half + height * Vec3::UnitZ()};
}

double Blank::volume() const {
  if (const auto* box = std::get_if<BoxShape>(&shape_))
    return box->size_x * box->size_y * box->height;
  const auto& f = std::get<FrustumShape>(shape_);
  return std::numbers::pi / 3.0 * f.height *
         (f.bottom_radius * f.bottom_radius + f.bottom_radius * f.top_radius +
          f.top_radius * f.top_radius);
}

}  // namespace frustum::stock

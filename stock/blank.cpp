#include "stock/blank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

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

// Faces of slab k of a loft: 6k + those of a box. How much half a size grows with z:
double growth(double from, double to, const LoftSlab& slab) {
  return 0.5 * (to - from) / (slab.top.z - slab.bottom.z);
}

Interval chord_of(const LoftSlab& slab, EndTag first_face, const Vec3& p, const Vec3& d,
                  RaySpan span) {
  Interval chord{span.lo, span.hi, -1, -1};
  const double up = p.z() - slab.bottom.z;
  const auto clip_sides = [&](double from, double to, Eigen::Index k, EndTag face) {
    const double m = growth(from, to, slab);
    const double half = 0.5 * from + m * up;
    clip(chord, -p[k] - half, -d[k] - m * d.z(), face);
    clip(chord, p[k] - half, d[k] - m * d.z(), face + 1);
  };
  clip_sides(slab.bottom.size_x, slab.top.size_x, 0, first_face);
  clip_sides(slab.bottom.size_y, slab.top.size_y, 1, first_face + 2);
  // A ray that passes a ledge must leave one slab where it enters the other, to the last bit.
  clip(chord, slab.bottom.z - p.z(), -d.z(), first_face + kBottom);
  clip(chord, p.z() - slab.top.z, d.z(), first_face + kTop);
  return chord;
}

std::optional<Diagnostic> fault_of(const LoftShape& shape) {
  const auto& all = shape.sections;
  constexpr const char* kHint = "sections = [[z, size_x, size_y], ...] from bottom to top, in mm";
  if (all.size() < 2) {
    return error(fmt::format("a loft needs two sections or more, given are {}", all.size()), kHint);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const LoftSection& s = all[i];
    const bool sized = std::isfinite(s.z) && std::isfinite(s.size_x) && std::isfinite(s.size_y) &&
                       s.size_x > 0.0 && s.size_y > 0.0;
    if (!sized) {
      return error(fmt::format("section {} of the loft is [{}, {}, {}]: its sizes must be finite "
                               "numbers above 0",
                               i + 1, s.z, s.size_x, s.size_y),
                   kHint);
    }
    if (i > 0 && s.z < all[i - 1].z) {
      return error(fmt::format("section {} of the loft, at z = {} mm, lies below the one before at "
                               "{} mm",
                               i + 1, s.z, all[i - 1].z),
                   kHint);
    }
    const bool ledge = i > 0 && s.z == all[i - 1].z;
    if (ledge && (i == 1 || i + 1 == all.size() || all[i - 2].z == s.z)) {
      return error(fmt::format("section {} of the loft is not needed: z = {} mm {}", i + 1, s.z,
                               i == 1                ? "is the bottom"
                               : i + 1 == all.size() ? "is the top"
                                                     : "has two sections already"),
                   "two sections at one z make a ledge between bottom and top");
    }
  }
  return std::nullopt;
}

Diagnostic empty_blank(const char* what, double value) {
  return error(fmt::format("the blank is empty: {} is {} mm", what, value),
               "every dimension must be a finite number above 0");
}

}  // namespace

std::vector<LoftSlab> slabs_of(const LoftShape& shape) {
  std::vector<LoftSlab> slabs;
  for (std::size_t i = 0; i + 1 < shape.sections.size(); ++i) {
    if (shape.sections[i].z < shape.sections[i + 1].z) {
      slabs.push_back({shape.sections[i], shape.sections[i + 1]});
    }
  }
  return slabs;
}

Result<Blank> Blank::make(const BlankShape& shape, const Vec3& origin) {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (!origin.allFinite()) return error("the blank's origin is not finite");
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    if (!positive(box->size_x)) return empty_blank("its size in X", box->size_x);
    if (!positive(box->size_y)) return empty_blank("its size in Y", box->size_y);
    if (!positive(box->height)) return empty_blank("its height", box->height);
  } else if (const auto* loft = std::get_if<LoftShape>(&shape)) {
    if (const auto fault = fault_of(*loft)) return *fault;
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
  if (const auto* loft = std::get_if<LoftShape>(&shape_)) {
    std::vector<Interval> chords;
    EndTag face = 0;
    for (const LoftSlab& slab : slabs_of(*loft)) {
      chords.push_back(chord_of(slab, face, p, d, span));
      face += 6;
    }
    return IntervalSet(std::move(chords));
  }
  Interval chord{span.lo, span.hi, -1, -1};
  if (const auto* box = std::get_if<BoxShape>(&shape_)) {
    const Vec3 lo(-box->size_x / 2, -box->size_y / 2, 0.0);
    const Vec3 hi(box->size_x / 2, box->size_y / 2, box->height);
    for (Eigen::Index k = 0; k < 3; ++k) {
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
  if (const auto* loft = std::get_if<LoftShape>(&shape_)) {
    const LoftSlab slab = slabs_of(*loft)[static_cast<std::size_t>(face / 6)];
    const EndTag side = face % 6;
    const auto k = static_cast<Eigen::Index>(side / 2);
    Vec3 outward = side % 2 == 0 ? Vec3(-Vec3::Unit(k)) : Vec3(Vec3::Unit(k));
    if (k == 2) return outward;
    const double m = k == 0 ? growth(slab.bottom.size_x, slab.top.size_x, slab)
                            : growth(slab.bottom.size_y, slab.top.size_y, slab);
    return (outward - m * Vec3::UnitZ()).normalized();
  }
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
  if (const auto* loft = std::get_if<LoftShape>(&shape_)) {
    Vec3 across = Vec3::Zero();
    for (const LoftSection& s : loft->sections) {
      across = across.cwiseMax(Vec3(0.5 * s.size_x, 0.5 * s.size_y, 0.0));
    }
    return {origin_ - across + loft->sections.front().z * Vec3::UnitZ(),
            origin_ + across + loft->sections.back().z * Vec3::UnitZ()};
  }
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
  if (const auto* loft = std::get_if<LoftShape>(&shape_)) {
    double volume = 0.0;
    for (const auto& [lo, hi] : slabs_of(*loft)) {
      // The sizes are linear in z, the section a quadratic: Simpson's rule is exact.
      const double middle = 0.25 * (lo.size_x + hi.size_x) * (lo.size_y + hi.size_y);
      volume +=
          (hi.z - lo.z) / 6.0 * (lo.size_x * lo.size_y + 4.0 * middle + hi.size_x * hi.size_y);
    }
    return volume;
  }
  if (const auto* box = std::get_if<BoxShape>(&shape_))
    return box->size_x * box->size_y * box->height;
  const auto& f = std::get<FrustumShape>(shape_);
  return std::numbers::pi / 3.0 * f.height *
         (f.bottom_radius * f.bottom_radius + f.bottom_radius * f.top_radius +
          f.top_radius * f.top_radius);
}

}  // namespace frustum::stock

#include "stock/solid/blank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace frustum::stock {
namespace {

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
  // Steeper than the mantle: inside before s1 and after s2; only one of them is on the nappe r >=
  // 0.
  const bool keep_before = chord.lo < s1 && r + k * d.z() * (std::max(chord.lo, s1 - 1.0)) >= 0.0;
  if (keep_before) {
    if (s1 < chord.hi) chord.hi = s1, chord.hi_tag = kMantle;
  } else if (s2 > chord.lo) {
    chord.lo = s2, chord.lo_tag = kMantle;
  }
}

// How much half a size grows with z.
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

IntervalSet chords_along(const BoxShape& box, const Vec3& p, const Vec3& d, RaySpan span) {
  Interval chord{span.lo, span.hi, -1, -1};
  const Vec3 lo(-box.size_x / 2, -box.size_y / 2, 0.0);
  const Vec3 hi(box.size_x / 2, box.size_y / 2, box.height);
  for (Eigen::Index k = 0; k < 3; ++k) {
    clip(chord, lo[k] - p[k], -d[k], 2 * k);
    clip(chord, p[k] - hi[k], d[k], 2 * k + 1);
  }
  return IntervalSet({chord});
}

IntervalSet chords_along(const FrustumShape& frustum, const Vec3& p, const Vec3& d, RaySpan span) {
  Interval chord{span.lo, span.hi, -1, -1};
  clip(chord, -p.z(), -d.z(), kBottom);
  clip(chord, p.z() - frustum.height, d.z(), kTop);
  if (chord.lo < chord.hi) clip_by_mantle(chord, frustum, p, d);
  return IntervalSet({chord});
}

// Faces are the facets.
IntervalSet chords_along(const MeshShape& mesh, const Vec3& p, const Vec3& d, RaySpan span) {
  return mesh.solid->along({p, d}, span);
}

// Faces of slab k: 6k + those of a box.
IntervalSet chords_along(std::span<const LoftSlab> slabs, const Vec3& p, const Vec3& d,
                         RaySpan span) {
  std::vector<Interval> chords;
  EndTag face = 0;
  for (const LoftSlab& slab : slabs) {
    chords.push_back(chord_of(slab, face, p, d, span));
    face += 6;
  }
  return IntervalSet(std::move(chords));
}

Vec3 box_normal(EndTag face) {
  const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(face / 2));
  return face % 2 == 0 ? Vec3(-axis) : axis;
}

// `across`: from the axis to the point.
Vec3 mantle_normal(const FrustumShape& frustum, const Vec3& across) {
  const double slope = (frustum.bottom_radius - frustum.top_radius) / frustum.height;
  return (across.normalized() + slope * Vec3::UnitZ()).normalized();
}

Vec3 slab_normal(const LoftSlab& slab, EndTag side) {
  Vec3 outward = box_normal(side);
  if (side >= kBottom) return outward;
  const double m = side < 2 ? growth(slab.bottom.size_x, slab.top.size_x, slab)
                            : growth(slab.bottom.size_y, slab.top.size_y, slab);
  return (outward - m * Vec3::UnitZ()).normalized();
}

// About the blank's origin.
BoundingBox bounds_of(const BoxShape& box) {
  const Vec3 half(box.size_x / 2, box.size_y / 2, 0.0);
  return {-half, half + box.height * Vec3::UnitZ()};
}

BoundingBox bounds_of(const FrustumShape& frustum) {
  const double radius = std::max(frustum.bottom_radius, frustum.top_radius);
  const Vec3 half(radius, radius, 0.0);
  return {-half, half + frustum.height * Vec3::UnitZ()};
}

BoundingBox bounds_of(const MeshShape& mesh) {
  BoundingBox box{mesh.solid->vertices().front(), mesh.solid->vertices().front()};
  for (const auto& facet : mesh.solid->facets()) {
    for (const std::uint32_t v : facet) {
      box.min = box.min.cwiseMin(mesh.solid->vertices()[v]);
      box.max = box.max.cwiseMax(mesh.solid->vertices()[v]);
    }
  }
  return box;
}

BoundingBox bounds_of(const LoftShape& loft) {
  Vec3 across = Vec3::Zero();
  for (const LoftSection& s : loft.sections) {
    across = across.cwiseMax(Vec3(0.5 * s.size_x, 0.5 * s.size_y, 0.0));
  }
  return {loft.sections.front().z * Vec3::UnitZ() - across,
          across + loft.sections.back().z * Vec3::UnitZ()};
}

double volume_of(const MeshShape& mesh) { return mesh.solid->volume(); }
double volume_of(const BoxShape& box) { return box.size_x * box.size_y * box.height; }

double volume_of(const FrustumShape& f) {
  return std::numbers::pi / 3.0 * f.height *
         (f.bottom_radius * f.bottom_radius + f.bottom_radius * f.top_radius +
          f.top_radius * f.top_radius);
}

double volume_of(const LoftShape& loft) {
  double volume = 0.0;
  for (const auto& [lo, hi] : slabs_of(loft)) {
    // The sizes are linear in z, the section a quadratic: Simpson's rule is exact.
    const double middle = 0.25 * (lo.size_x + hi.size_x) * (lo.size_y + hi.size_y);
    volume += (hi.z - lo.z) / 6.0 * (lo.size_x * lo.size_y + 4.0 * middle + hi.size_x * hi.size_y);
  }
  return volume;
}

Diagnostic empty_blank(const char* what, double value) {
  return error("empty-blank"_id, fmt::format("the blank is empty: {} is {} mm", what, value),
               "every dimension must be a finite number above 0");
}

bool positive(double v) { return std::isfinite(v) && v > 0.0; }

std::optional<Diagnostic> fault_of(const BoxShape& box) {
  if (!positive(box.size_x)) return empty_blank("its size in X", box.size_x);
  if (!positive(box.size_y)) return empty_blank("its size in Y", box.size_y);
  if (!positive(box.height)) return empty_blank("its height", box.height);
  return std::nullopt;
}

std::optional<Diagnostic> fault_of(const FrustumShape& frustum) {
  if (!positive(frustum.height)) return empty_blank("its height", frustum.height);
  if (!positive(frustum.bottom_radius)) {
    return empty_blank("its bottom radius", frustum.bottom_radius);
  }
  if (!positive(frustum.top_radius)) return empty_blank("its top radius", frustum.top_radius);
  return std::nullopt;
}

std::optional<Diagnostic> fault_of(const MeshShape& mesh) {
  if (mesh.solid == nullptr || mesh.solid->facets().empty()) {
    return error("empty-blank"_id, "the blank's mesh has no facets");
  }
  if (!(mesh.solid->volume() > 0.0)) {
    return error("empty-blank"_id,
                 fmt::format("the blank's mesh holds {} mm3", mesh.solid->volume()),
                 "its facets must face out of the material");
  }
  return std::nullopt;
}

std::optional<Diagnostic> fault_of(const LoftShape& shape) {
  const auto& all = shape.sections;
  constexpr const char* kHint = "sections = [[z, size_x, size_y], ...] from bottom to top, in mm";
  if (all.size() < 2) {
    return error("blank-loft"_id,
                 fmt::format("a loft needs two sections or more, given are {}", all.size()), kHint);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const LoftSection& s = all[i];
    const bool sized = std::isfinite(s.z) && std::isfinite(s.size_x) && std::isfinite(s.size_y) &&
                       s.size_x > 0.0 && s.size_y > 0.0;
    if (!sized) {
      return error("blank-loft"_id,
                   fmt::format("section {} of the loft is [{}, {}, {}]: its sizes must be finite "
                               "numbers above 0",
                               i + 1, s.z, s.size_x, s.size_y),
                   kHint);
    }
    if (i > 0 && s.z < all[i - 1].z) {
      return error("blank-loft"_id,
                   fmt::format("section {} of the loft, at z = {} mm, is below the one before at "
                               "{} mm",
                               i + 1, s.z, all[i - 1].z),
                   kHint);
    }
    const bool ledge = i > 0 && s.z == all[i - 1].z;
    if (ledge && (i == 1 || i + 1 == all.size() || all[i - 2].z == s.z)) {
      return error("blank-loft"_id,
                   fmt::format("section {} of the loft is not needed: z = {} mm {}", i + 1, s.z,
                               i == 1                ? "is the bottom"
                               : i + 1 == all.size() ? "is the top"
                                                     : "has two sections already"),
                   "two sections at one z make a ledge between bottom and top");
    }
  }
  return std::nullopt;
}

// Calls the one of its functions that takes the shape.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

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

Blank::Blank(const BlankShape& shape, const Vec3& origin) : shape_(shape), origin_(origin) {
  if (const auto* loft = std::get_if<LoftShape>(&shape_)) slabs_ = slabs_of(*loft);
}

Result<Blank> Blank::make(const BlankShape& shape, const Vec3& origin) {
  if (!origin.allFinite()) return error("blank-origin"_id, "the blank's origin is not finite");
  if (const auto fault = std::visit([](const auto& s) { return fault_of(s); }, shape)) {
    return *fault;
  }
  Blank blank(shape, origin);
  // As of other bodies; rounding is 1e-11 mm there.
  constexpr double kFarthest = 1e5;  // mm
  const Box box = blank.bounds();
  const double reach = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  if (!(reach <= kFarthest)) {
    return error("blank-too-far"_id, fmt::format("the blank reaches {:.3g} mm", reach),
                 fmt::format("sizes and places of a blank are at most {:g} mm", kFarthest));
  }
  return blank;
}

IntervalSet Blank::along(const Ray& ray, RaySpan span) const {
  const Vec3 p = ray.origin - origin_;
  const Vec3& d = ray.direction;
  return std::visit(Overloaded{[&](const LoftShape&) { return chords_along(slabs_, p, d, span); },
                               [&](const auto& shape) { return chords_along(shape, p, d, span); }},
                    shape_);
}

Vec3 Blank::normal(EndTag face, const Vec3& point) const {
  return std::visit(
      Overloaded{[&](const BoxShape&) { return box_normal(face); },
                 [&](const FrustumShape& frustum) {
                   if (face < kMantle) return box_normal(face);
                   return mantle_normal(
                       frustum, Vec3(point.x() - origin_.x(), point.y() - origin_.y(), 0.0));
                 },
                 [&](const MeshShape& mesh) { return mesh.solid->normal(face); },
                 [&](const LoftShape&) {
                   return slab_normal(slabs_[static_cast<std::size_t>(face / 6)], face % 6);
                 }},
      shape_);
}

BoundingBox Blank::bounds() const {
  const BoundingBox box = std::visit([](const auto& shape) { return bounds_of(shape); }, shape_);
  return {origin_ + box.min, origin_ + box.max};
}

double Blank::volume() const {
  return std::visit([](const auto& shape) { return volume_of(shape); }, shape_);
}

}  // namespace frustum::stock

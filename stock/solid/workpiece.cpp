#include "stock/solid/workpiece.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace frustum::stock {
namespace {

// Ends made by a sweep carry the segment (>= 0); ends of the blank carry their face below -1.
EndTag tag_of_face(EndTag face) { return face < 0 ? face : -2 - face; }
EndTag face_of_tag(EndTag tag) { return -2 - tag; }

// Material thinner than this is what rounding leaves of a cut that is flush with a face.
constexpr double kSkin = 1e-9;  // mm

// As derived in the header; `size`: the sum of all lengths that go into the point.
double rounding(double size) { return 32.0 * std::numeric_limits<double>::epsilon() * size; }

// Facets are met within 1e-12 of the size of their mesh; below a metre that is this.
double facet_bound(const Blank& blank) {
  return std::holds_alternative<MeshShape>(blank.shape()) ? 1e-9 : 0.0;  // mm
}

IntervalSet uncut_along(const Blank& blank, const Ray& ray, RaySpan span) {
  const IntervalSet uncut = blank.along(ray, span);
  std::vector<Interval> chords(uncut.intervals().begin(), uncut.intervals().end());
  for (Interval& chord : chords) {
    chord.lo_tag = tag_of_face(chord.lo_tag);
    chord.hi_tag = tag_of_face(chord.hi_tag);
  }
  return IntervalSet(std::move(chords));
}

// The sweeps are asked a little beyond the blank, so that a cut flush with its face leaves no skin;
// nowhere beside it.
RaySpan asked_of(const IntervalSet& uncut) {
  constexpr double kBeyond = 1e-3;  // mm
  if (uncut.empty()) return {1.0, 0.0};
  return {uncut.intervals().front().lo - kBeyond, uncut.intervals().back().hi + kBeyond};
}

}  // namespace

Workpiece::Workpiece(Blank blank, cutter::SweptCutter removed)
    : blank_(std::move(blank)), removed_(std::move(removed)) {}

IntervalSet Workpiece::material_along(const Ray& ray, RaySpan span) const {
  return material_along(ray, span, cutter::SweptCutter::kAll);
}

IntervalSet Workpiece::material_along(const Ray& ray, RaySpan span,
                                      std::uint32_t first_excluded_segment) const {
  IntervalSet uncut = uncut_along(blank_, ray, span);
  if (uncut.empty()) return uncut;
  return uncut.minus(removed_.along(ray, asked_of(uncut), first_excluded_segment));
}

std::vector<IntervalSet> Workpiece::material_along_all(std::span<const Ray> rays, std::size_t row,
                                                       RaySpan span,
                                                       std::uint32_t first_excluded_segment) const {
  std::vector<IntervalSet> all;
  std::vector<RaySpan> asked;
  all.reserve(rays.size());
  asked.reserve(rays.size());
  for (const Ray& ray : rays) {
    all.push_back(uncut_along(blank_, ray, span));
    asked.push_back(asked_of(all.back()));
  }
  const auto removed = removed_.along_all(rays, asked, row, first_excluded_segment);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    if (!removed[r].empty()) all[r] = all[r].minus(removed[r]);
  }
  return all;
}

SurfacePoint Workpiece::surface_at(const Ray& ray, double s, EndTag tag) const {
  SurfacePoint found{.s = s, .point = ray.at(s)};
  if (tag >= 0)
    return surface_point(ray, removed_.contact(ray, s, static_cast<std::uint32_t>(tag)));
  if (tag <= -2) {
    found.normal = blank_.normal(face_of_tag(tag), found.point);
    const double size = ray.origin.norm() + std::abs(s) + blank_.origin().norm();
    found.bound = found.sweep_bound = rounding(size) + facet_bound(blank_);
  } else {
    found.normal = -ray.direction;  // the end of the span asked for, not a surface
  }
  return found;
}

SurfacePoint Workpiece::surface_point(const Ray& ray, const cutter::SweepContact& contact) const {
  const auto& path = removed_.path();
  const kinematics::PathBlock& block = path.blocks[path.segments[contact.segment].block];
  const double size = ray.origin.norm() + std::abs(contact.s) + contact.pose.tip.norm() +
                      removed_.tool(block.tool).body().reach();
  const double sweep_bound = removed_.accuracy() + rounding(size);
  return {.s = contact.s,
          .point = ray.at(contact.s),
          .normal = -contact.normal,
          .segment = contact.segment,
          .source_line = block.source_line,
          .t = contact.t,
          .sweep_bound = sweep_bound,
          .bound = path.bound + sweep_bound};
}

std::optional<SurfacePoint> Workpiece::first_surface(const Ray& ray, RaySpan span,
                                                     std::uint32_t first_excluded_segment) const {
  return first_surface(ray, span, {}, first_excluded_segment);
}

std::optional<SurfacePoint> Workpiece::first_surface(const Ray& ray, RaySpan span,
                                                     const cutter::SweptCutter::Likely& likely,
                                                     std::uint32_t first_excluded_segment) const {
  const IntervalSet uncut = blank_.along(ray, span);
  for (const Interval& chord : uncut.intervals()) {
    const auto contact =
        removed_.end_of_void(ray, chord.lo, chord.hi, likely, first_excluded_segment);
    if (!contact) {
      if (chord.lo_tag == -1) return std::nullopt;  // the span begins inside the material
      return surface_at(ray, chord.lo, tag_of_face(chord.lo_tag));
    }
    if (contact->s >= chord.hi - kSkin) continue;
    return surface_point(ray, *contact);
  }
  return std::nullopt;
}

}  // namespace frustum::stock

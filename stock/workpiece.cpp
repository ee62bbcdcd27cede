#include "stock/workpiece.hpp"

#include <utility>
#include <vector>

namespace frustum::stock {
namespace {

// Ends made by a sweep carry the stretch (>= 0); ends of the blank carry their face below -1.
EndTag tag_of_face(EndTag face) { return face < 0 ? face : -2 - face; }
EndTag face_of_tag(EndTag tag) { return -2 - tag; }

}  // namespace

Workpiece::Workpiece(Blank blank, cutter::SweptCutter removed)
    : blank_(std::move(blank)), removed_(std::move(removed)) {}

IntervalSet Workpiece::material_along(const Ray& ray, RaySpan span) const {
  return material_along(ray, span, cutter::SweptCutter::kAll);
}

IntervalSet Workpiece::material_along(const Ray& ray, RaySpan span,
                                      std::uint32_t first_excluded_stretch) const {
  const IntervalSet uncut = blank_.along(ray, span);
  if (uncut.empty()) return uncut;
  std::vector<Interval> chords(uncut.intervals().begin(), uncut.intervals().end());
  for (Interval& chord : chords) {
    chord.lo_tag = tag_of_face(chord.lo_tag);
    chord.hi_tag = tag_of_face(chord.hi_tag);
  }
  // The sweeps are asked a little beyond the blank, so that a cut flush with its face leaves no skin.
  constexpr double kBeyond = 1e-3;  // mm
  const RaySpan asked{chords.front().lo - kBeyond, chords.back().hi + kBeyond};
  return IntervalSet(std::move(chords)).minus(removed_.along(ray, asked, first_excluded_stretch));
}

SurfacePoint Workpiece::surface_at(const Ray& ray, double s, EndTag tag) const {
  SurfacePoint found{.s = s, .point = ray.at(s)};
  if (tag >= 0) {
    const auto stretch = static_cast<std::uint32_t>(tag);
    found.normal = -removed_.contact(ray, s, stretch).normal;
    found.stretch = stretch;
    const auto& path = removed_.path();
    found.source_line = path.blocks[path.stretches[stretch].block].source_line;
  } else if (tag <= -2) {
    found.normal = blank_.normal(face_of_tag(tag), found.point);
  } else {
    found.normal = -ray.direction;  // the end of the span asked for, not a surface
  }
  return found;
}

std::optional<SurfacePoint> Workpiece::first_surface(const Ray& ray, RaySpan span) const {
  const IntervalSet material = material_along(ray, span);
  if (material.empty()) return std::nullopt;
  const Interval& first = material.intervals().front();
  if (first.lo_tag == -1) return std::nullopt;  // the span begins inside the material
  return surface_at(ray, first.lo, first.lo_tag);
}

}  // namespace frustum::stock

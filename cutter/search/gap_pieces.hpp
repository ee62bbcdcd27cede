// What of many gaps on a ray their segments may cover: the rest is proven empty for many at once.
//
// Model    : a cutter at one moment is farther from the middle of a piece of ray than half of the
//            piece, and than it is from where it stands at any other moment of a run of segments:
//            then none of them covers any of it. Else the piece is halved, or the run, whichever is
//            longer
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : nothing is left out that enters by more than rounding
// Source   : ours
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cutter/body/body.hpp"
#include "cutter/search/ray_search.hpp"

namespace frustum::cutter {

// A piece of ray that a segment may cover.
struct RayGap {
  std::uint32_t segment = 0;
  double lo = 0.0, hi = 0.0;
};
// Of the gap with that number.
struct GapPiece {
  std::uint32_t gap = 0;
  double lo = 0.0, hi = 0.0;
};

// By gap, and along the ray.
[[nodiscard]] std::vector<GapPiece> pieces_to_walk(const RayQuestion& question, const Body& body,
                                                   std::span<const RayGap> gaps);

}  // namespace frustum::cutter

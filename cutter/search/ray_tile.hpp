// What the sweeps of one tool cover of parallel rays side by side, found together.
//
// Model    : the ray in the middle of a tile is searched; then groups that cover nothing more, on
//            any ray of the tile, than the cutters at its ends do, and those that link these along
//            the path, are left aside for all (tile_cover.hpp), and so are groups beside the tile.
//            What is left is asked for the quarters of the tile, and so on down to single rays:
//            each begins with the segments that made its neighbour's ends, climbed to its own, and
//            leaves aside what the planes of a small tile hold back there (end_fan.hpp)
// Units    : mm along the rays; frame: workpiece
// Errors   : none
// Accuracy : bit for bit that of extend_swept_interval() for each ray
//            (tests/stock/ray_map_test.cpp)
// Source   : ours
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "cutter/body/cutter.hpp"
#include "cutter/search/ray_search.hpp"

namespace frustum::cutter {

// Rays of one direction, in rows of `row`, neighbours near each other. Where a span is empty (lo
// above hi), that ray is not asked.
struct TileQuestion {
  const kinematics::ToolPath* path = nullptr;
  const std::map<int, Cutter>* tools = nullptr;  // by number, as the blocks name them
  std::span<const Ray> rays{};
  std::span<const RaySpan> spans{};
  std::size_t row = 1;
  std::uint32_t first_excluded = 0;
};

// `swept` by ray: what other tools cover already. Precondition: all tools are convex (Body without
// concave sections).
void extend_swept_intervals(const TileQuestion& question, const ToolSweep& sweep,
                            std::span<std::vector<SweptInterval>> swept);

}  // namespace frustum::cutter

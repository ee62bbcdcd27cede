// Neighbouring vertices in blocks of about the same number, for work on many of them at once.
//
// Model    : halves of halves, across the longest of three directions, by the middle of some of the
//            vertices; those of each round are turned, so that blocks of one round have their
//            borders within those of the next
// Units    : mm
// Errors   : none
// Threads  : runs on oneTBB; the same blocks for any number of threads
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum::stock {

// Of `order`: from `first` until before `last`.
struct SurfaceBlock {
  std::size_t first = 0;
  std::size_t last = 0;
};

// Reorders `order`, vertices by number, so that the vertices of each block follow one another.
[[nodiscard]] std::vector<SurfaceBlock> surface_blocks(std::span<const Vec3> vertices,
                                                       std::span<std::uint32_t> order, int round);

}  // namespace frustum::stock

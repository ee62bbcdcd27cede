// A mesh with other numbers: what is near by has near numbers, so that a part of it is in one piece
// of memory.
//
// Units    : mm
// Shape    : triangles with their lowest vertex first, and in the order of that
// Errors   : none
// Threads  : runs on oneTBB; the same numbers for any number of threads
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

struct NearNumbers {
  std::vector<std::uint32_t> given{};  // by near number of a vertex
  std::vector<std::uint32_t> near{};   // by given number
  std::vector<Vec3> points{};
  std::vector<std::array<std::uint32_t, 3>> triangles{};
};
[[nodiscard]] NearNumbers near_numbers(const SurfaceMesh& mesh);

}  // namespace frustum::stock

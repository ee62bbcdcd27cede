#include "report/page/packed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/page/packed_array.hpp"

namespace frustum::report {

PackedMesh packed_mesh(std::span<const std::array<float, 3>> vertices,
                       std::span<const std::array<std::uint32_t, 3>> triangles, double grid) {
  std::array<float, 3> low = vertices.front();
  std::array<float, 3> high = low;
  for (const auto& vertex : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], vertex[k]);
      high[k] = std::max(high[k], vertex[k]);
    }
  }
  double side = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, static_cast<double>(high[k] - low[k]));
  const double step = side / grid;
  std::vector<std::uint32_t> positions;
  positions.reserve(vertices.size() * 3);
  for (const auto& vertex : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      positions.push_back(
          static_cast<std::uint32_t>(std::lround(static_cast<double>(vertex[k] - low[k]) / step)));
    }
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(triangles.size() * 3);
  for (const auto& triangle : triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return {.vertices = vertices.size(),
          .triangles = triangles.size(),
          .origin = low,
          .step = step,
          .positions = packed_array(positions, 3),
          .corners = packed_array(corners, 3)};
}

}  // namespace frustum::report

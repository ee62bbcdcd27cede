#include "stock/mesh/surface_blocks.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace frustum::stock {
namespace {

// What a core has at hand of a mesh (100 to 200 bytes a vertex) is in its cache then.
constexpr std::size_t kMostVertices = 1024;

struct Divider {
  std::span<const Vec3> vertices;
  std::span<std::uint32_t> order;
  std::vector<SurfaceBlock>& blocks;
  std::size_t depth;  // at which no block is larger
  Mat3 turned;

  // Block `number` of those at `level`.
  void divide(std::size_t first, std::size_t last, std::size_t level, std::size_t number) const {
    if (level == depth) {
      blocks[number] = {first, last};
      return;
    }
    Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 hi = -lo;
    for (std::size_t k = first; k < last; ++k) {
      const Vec3 at = turned * vertices[order[k]];
      lo = lo.cwiseMin(at);
      hi = hi.cwiseMax(at);
    }
    Eigen::Index longest = 0;
    (hi - lo).maxCoeff(&longest);
    const Vec3 along = turned.row(longest).transpose();
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      const double there = along.dot(vertices[a]);
      const double here = along.dot(vertices[b]);
      return there != here ? there < here : a < b;
    });
    tbb::parallel_invoke([&] { divide(first, middle, level + 1, 2 * number); },
                         [&] { divide(middle, last, level + 1, 2 * number + 1); });
  }
};

}  // namespace

std::vector<SurfaceBlock> surface_blocks(std::span<const Vec3> vertices,
                                         std::span<std::uint32_t> order, int round) {
  std::size_t depth = 0;
  while ((order.size() >> depth) > kMostVertices) ++depth;
  std::vector<SurfaceBlock> blocks(std::size_t{1} << depth);
  // No two of some rounds are near each other: a turn of 1 rad is no part of a right angle.
  const Eigen::AngleAxisd turn(round, Vec3(1.0, 2.0, 3.0).normalized());
  const Divider divider{vertices, order, blocks, depth, turn.toRotationMatrix()};
  divider.divide(0, order.size(), 0, 0);
  return blocks;
}

}  // namespace frustum::stock

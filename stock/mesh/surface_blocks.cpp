#include "stock/mesh/surface_blocks.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace frustum::stock {
namespace {

// What a core has at hand of a mesh (100 to 200 bytes a vertex) is in its cache then.
constexpr std::size_t kMostVertices = 1024;
// One vertex in so many says where the planes go.
constexpr std::size_t kSampled = 16;

// Planes that halve again and again: those of number n are halved by numbers 2 n and 2 n + 1.
class Halves {
 public:
  Halves(std::span<const Vec3> vertices, std::span<const std::uint32_t> order, std::size_t depth,
         const Mat3& turned)
      : turned_(turned), planes_(std::size_t{1} << depth) {
    std::vector<Sample> samples;
    samples.reserve(order.size() / kSampled + 1);
    for (std::size_t k = 0; k < order.size(); k += kSampled)
      samples.push_back({0.0, vertices[order[k]]});
    divide(1, samples);
  }

  // Counted from 0.
  [[nodiscard]] std::size_t block_of(const Vec3& vertex) const {
    std::size_t n = 1;
    while (n < planes_.size()) {
      const Plane& plane = planes_[n];
      n = 2 * n + (plane.normal.dot(vertex) < plane.at ? 0 : 1);
    }
    return n - planes_.size();
  }

 private:
  struct Plane {
    Vec3 normal = Vec3::UnitX();
    double at = 0.0;
  };
  struct Sample {
    double along;
    Vec3 at;
  };

  void divide(std::size_t n, std::span<Sample> samples) {
    if (n >= planes_.size() || samples.empty()) return;
    Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 hi = -lo;
    for (const Sample& each : samples) {
      const Vec3 at = turned_ * each.at;
      lo = lo.cwiseMin(at);
      hi = hi.cwiseMax(at);
    }
    Eigen::Index longest = 0;
    (hi - lo).maxCoeff(&longest);
    Plane& plane = planes_[n];
    plane.normal = turned_.row(longest).transpose();
    for (Sample& each : samples) each.along = plane.normal.dot(each.at);
    const std::size_t half = samples.size() / 2;
    std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(half),
                     samples.end(),
                     [](const Sample& a, const Sample& b) { return a.along < b.along; });
    plane.at = samples[half].along;
    tbb::parallel_invoke([&] { divide(2 * n, samples.first(half)); },
                         [&] { divide(2 * n + 1, samples.subspan(half)); });
  }

  Mat3 turned_;
  std::vector<Plane> planes_;
};

}  // namespace

std::vector<SurfaceBlock> surface_blocks(std::span<const Vec3> vertices,
                                         std::span<std::uint32_t> order, int round) {
  std::size_t depth = 0;
  while ((order.size() >> depth) > kMostVertices) ++depth;
  // No two of some rounds are near each other, or along the grid of a mesh: a turn of 1 rad is no
  // part of a right angle.
  const Eigen::AngleAxisd turn(round + 1, Vec3(1.0, 2.0, 3.0).normalized());
  const Halves halves(vertices, order, depth, turn.toRotationMatrix());
  std::vector<std::uint32_t> block(order.size());
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
    block[k] = static_cast<std::uint32_t>(halves.block_of(vertices[order[k]]));
  });
  std::vector<SurfaceBlock> blocks(std::size_t{1} << depth);
  for (const std::uint32_t b : block) ++blocks[b].last;
  std::size_t first = 0;
  for (SurfaceBlock& each : blocks) {
    const std::size_t count = each.last;
    each = {first, first};
    first += count;
  }
  const std::vector<std::uint32_t> before(order.begin(), order.end());
  for (std::size_t k = 0; k < before.size(); ++k) order[blocks[block[k]].last++] = before[k];
  return blocks;
}

}  // namespace frustum::stock

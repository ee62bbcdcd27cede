#include "stock/mesh/near_numbers.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "stock/mesh/surface_blocks.hpp"

namespace frustum::stock {

NearNumbers near_numbers(const SurfaceMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  NearNumbers numbers{
      .given = std::vector<std::uint32_t>(count),
      .near = std::vector<std::uint32_t>(count),
      .points = std::vector<Vec3>(count),
      .triangles = std::vector<std::array<std::uint32_t, 3>>(mesh.triangles.size())};
  std::iota(numbers.given.begin(), numbers.given.end(), 0U);
  static_cast<void>(surface_blocks(mesh.vertices, numbers.given, 0));
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t v) {
    numbers.near[numbers.given[v]] = v;
    numbers.points[v] = mesh.vertices[numbers.given[v]];
  });
  const auto turned = [&](std::array<std::uint32_t, 3> triangle) {
    for (std::uint32_t& v : triangle) v = numbers.near[v];
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    return triangle;
  };
  const auto counted = [](std::uint32_t& number) {
    return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed);
  };
  std::vector<std::uint32_t> first(count + 1, 0);
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(),
                    [&](std::size_t t) { counted(first[turned(mesh.triangles[t])[0] + 1]); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    const auto triangle = turned(mesh.triangles[t]);
    numbers.triangles[counted(filled[triangle[0]])] = triangle;
  });
  // Those of one vertex came in any order.
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t v) {
    std::sort(numbers.triangles.begin() + first[v], numbers.triangles.begin() + first[v + 1]);
  });
  return numbers;
}

}  // namespace frustum::stock

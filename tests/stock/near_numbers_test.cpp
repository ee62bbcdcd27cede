#include "stock/mesh/near_numbers.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "stock/mesh/triangle_links.hpp"

namespace frustum::stock {
namespace {

// A wavy sheet of side^2 squares; what is near by is a side apart in the order of its vertices.
SurfaceMesh sheet(std::uint32_t side) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j)
      mesh.vertices.emplace_back(i, j, 3.0 * std::sin(0.1 * i) * std::cos(0.07 * j));
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t at = i * (side + 1) + j;
      mesh.triangles.push_back({at, at + side + 1, at + side + 2});
      mesh.triangles.push_back({at + side + 2, at + 1, at});
    }
  }
  return mesh;
}

TEST(NearNumbers, AreThoseOfTheSameMesh) {
  const SurfaceMesh mesh = sheet(150);
  const NearNumbers numbers = near_numbers(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    ASSERT_EQ(numbers.near[numbers.given[v]], v);
    ASSERT_EQ(numbers.points[v], mesh.vertices[numbers.given[v]]);
  }
  const auto lowest_first = [](std::array<std::uint32_t, 3> t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
  };
  auto given = mesh.triangles, back = numbers.triangles;
  for (auto& t : given) t = lowest_first(t);
  for (auto& t : back) {
    EXPECT_EQ(t, lowest_first(t));
    for (std::uint32_t& v : t) v = numbers.given[v];
    t = lowest_first(t);
  }
  std::ranges::sort(given);
  std::ranges::sort(back);
  EXPECT_EQ(back, given);
  EXPECT_TRUE(std::ranges::is_sorted(numbers.triangles));
}

// 22,801 vertices are 32 blocks of 713: neighbours in the sheet are in one block as a rule.
TEST(NearNumbers, OfNeighboursAreNear) {
  const SurfaceMesh mesh = sheet(150);
  const NearNumbers numbers = near_numbers(mesh);
  std::size_t near = 0;
  for (const auto& [a, b, c] : numbers.triangles) near += c - a < 1000 && b - a < 1000 ? 1 : 0;
  EXPECT_GT(10 * near, 8 * numbers.triangles.size());
}

TEST(NearNumbers, AreTheSameForAnyNumberOfThreads) {
  const SurfaceMesh mesh = sheet(300);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return near_numbers(mesh);
  };
  const NearNumbers one = with(1);
  for (const std::size_t threads : {2U, 8U}) {
    const NearNumbers many = with(threads);
    EXPECT_EQ(many.given, one.given);
    EXPECT_EQ(many.triangles, one.triangles);
  }
}

TEST(NearNumbers, OfNothingAreNone) { EXPECT_TRUE(near_numbers({}).triangles.empty()); }

// Two tetrahedra that share an edge: four triangles there.
TEST(TriangleLinks, RefusesAnEdgeOfFourTriangles) {
  std::vector<std::array<std::uint32_t, 3>> one = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  EXPECT_TRUE(linked(one, 4));
  for (const auto& t : {std::array{0U, 1U, 4U}, {0U, 5U, 1U}, {1U, 5U, 4U}, {4U, 5U, 0U}})
    one.push_back(t);
  EXPECT_FALSE(linked(one, 6));
}

// Two that touch in a vertex: two fans there.
TEST(TriangleLinks, RefusesTwoFansAtAVertex) {
  std::vector<std::array<std::uint32_t, 3>> both = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  for (const auto& t : {std::array{0U, 4U, 5U}, {0U, 6U, 4U}, {4U, 6U, 5U}, {5U, 6U, 0U}})
    both.push_back(t);
  EXPECT_FALSE(linked(both, 7));
  both.resize(4);
  EXPECT_TRUE(linked(both, 4));
  both[3] = {2, 0, 3};  // turned inside out
  EXPECT_FALSE(linked(both, 4));
}

}  // namespace
}  // namespace frustum::stock

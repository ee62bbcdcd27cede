#include "stock/mesh/open_edges.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "core/random.hpp"

namespace frustum::stock {
namespace {

// A torus of n by n quadrangles, each split in two.
SurfaceMesh torus(std::uint32_t n) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < n * n; ++i) mesh.vertices.emplace_back(i, 2.0 * i, -3.0 * i);
  const auto at = [n](std::uint32_t i, std::uint32_t j) { return (i % n) * n + j % n; };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// How often each edge is run from its lower vertex to the higher one, less the other way.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> balances(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> all;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      all[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::erase_if(all, [](const auto& each) { return each.second == 0; });
  return all;
}

TEST(OpenEdges, AClosedMeshHasNone) {
  EXPECT_FALSE(open_edges({}));
  for (const std::uint32_t n : {3U, 7U, 40U}) EXPECT_FALSE(open_edges(torus(n))) << n;
}

TEST(OpenEdges, LawHolesAndTurnedFacetsAreCountedAndPlaced) {
  const RandomKey key{3, 0, RandomPurpose::test_data};
  std::uint64_t index = 0;
  for (int round = 0; round < 200; ++round) {
    SurfaceMesh mesh = torus(9);
    for (int change = 0; change <= round % 5; ++change) {
      const auto k = static_cast<std::size_t>(uniform(key, index++) *
                                              static_cast<double>(mesh.triangles.size()));
      if (uniform(key, index++) < 0.5) {
        mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(k));
      } else {
        std::swap(mesh.triangles[k][0], mesh.triangles[k][1]);
      }
    }
    const auto expected = balances(mesh);
    const auto found = open_edges(mesh);
    ASSERT_EQ(found.has_value(), !expected.empty());
    if (!found) continue;
    EXPECT_EQ(found->count, expected.size());
    EXPECT_EQ(found->from, mesh.vertices[expected.begin()->first.first]);
    EXPECT_EQ(found->to, mesh.vertices[expected.begin()->first.second]);
  }
}

}  // namespace
}  // namespace frustum::stock

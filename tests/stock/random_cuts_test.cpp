#include "tests/stock/random_cuts.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include "tests/law_count.hpp"

namespace frustum::proof {
namespace {

// 20 to 50 ms each.
int cuts() {
  const char* wanted = std::getenv("FRUSTUM_RANDOM_CUTS");
  return wanted ? std::atoi(wanted) : law_count(10000, 240);
}

// In four parts, so that several can run at once.
class RandomCutLaws : public ::testing::TestWithParam<int> {};

TEST_P(RandomCutLaws, LeaveAClosedBodyThatOnlyShrinks) {
  int broken = 0;
  for (int seed = GetParam(); seed < cuts(); seed += 4) {
    const std::string fault = broken_law(random_cut(static_cast<std::uint64_t>(seed)));
    if (fault.empty()) continue;
    if (++broken <= 5) ADD_FAILURE() << "seed " << seed << ": " << fault;
  }
  EXPECT_EQ(broken, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCutLaws, ::testing::Range(0, 4));

stock::SurfaceMesh tetrahedron() {
  return {.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST(RandomCuts, TellOpenAndTangledMeshesFromClosedOnes) {
  EXPECT_EQ(open_or_not_manifold(tetrahedron()), "");
  stock::SurfaceMesh open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_EQ(open_or_not_manifold(open), "an open edge");
  stock::SurfaceMesh turned = tetrahedron();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(open_or_not_manifold(turned), "an edge of two triangles on one side");
  // Two that share one vertex.
  stock::SurfaceMesh pinched = tetrahedron();
  for (const auto& [a, b, c] : tetrahedron().triangles) {
    const auto other = [](std::uint32_t v) { return v == 0 ? 0U : v + 3U; };
    pinched.triangles.push_back({other(a), other(b), other(c)});
  }
  for (int d = 0; d < 3; ++d) pinched.vertices.push_back(-Vec3::Unit(d));
  EXPECT_EQ(open_or_not_manifold(pinched), "a vertex of two fans");
}

}  // namespace
}  // namespace frustum::proof

#include "stock/dexel/tri_dexel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/stock/surface_mesh_solids.hpp"

namespace frustum::stock {
namespace {

using testing::BallBody;
using testing::box_around;
using testing::BoxBody;
using ::testing::HasSubstr;
using testing::Solid;

const Solid kBall{{{BallBody{5.0}}}};
const BoundingBox kBallBox = box_around(Vec3::Zero(), 5.0);

TEST(TriDexel, KeepsTheExactChordOfEveryRay) {
  const auto dexels = TriDexel::sample(kBall, kBallBox, Mm{0.7});
  ASSERT_TRUE(dexels);
  const DexelGrid& grid = dexels->grid();
  for (int axis = 0; axis < 3; ++axis) {
    for (int v = 0; v < grid.nodes[static_cast<std::size_t>((axis + 2) % 3)]; ++v) {
      for (int u = 0; u < grid.nodes[static_cast<std::size_t>((axis + 1) % 3)]; ++u) {
        const Ray ray = grid.ray(axis, u, v);
        const double across = ray.origin.cross(ray.direction).norm();
        const auto material = dexels->material(axis, u, v);
        ASSERT_EQ(material.size(), across < 5.0 ? 1U : 0U);
        if (material.empty()) continue;
        EXPECT_NEAR(ray.at(material[0].lo).norm(), 5.0, 1e-12);
        EXPECT_NEAR(material[0].length(), 2.0 * std::sqrt(25.0 - across * across), 1e-10);
      }
    }
  }
}

TEST(TriDexel, LeavesTheOutermostNodesOutsideTheBox) {
  const auto dexels = TriDexel::sample(kBall, kBallBox, Mm{0.7});
  ASSERT_TRUE(dexels);
  const DexelGrid& grid = dexels->grid();
  const Vec3 last = grid.node(grid.nodes[0] - 1, grid.nodes[1] - 1, grid.nodes[2] - 1);
  EXPECT_GT((kBallBox.min - grid.origin).minCoeff(), 0.7);
  EXPECT_GE((last - kBallBox.max).minCoeff(), 0.7);
  EXPECT_LT((last - kBallBox.max).maxCoeff(), 1.41);
}

TEST(TriDexel, CutsOffWhatReachesOutOfItsBox) {
  const Solid large{{{BoxBody{Vec3::Constant(100.0)}}}};
  const auto dexels = TriDexel::sample(large, box_around(Vec3::Zero(), 2.0), Mm{0.5});
  ASSERT_TRUE(dexels);
  EXPECT_GT(dexels->volume(), 4.0 * 4.0 * 4.0);
  EXPECT_LT(dexels->volume(), 6.0 * 6.0 * 6.0);
}

// The error oscillates under an envelope of order 2, because rays enter and leave the silhouette;
// so the law is held against the envelope over a factor of 32 in pitch. Largest factor seen: 4.3.
TEST(TriDexel, VolumeConvergesAtOrderTwo) {
  const double exact = 4.0 / 3.0 * std::numbers::pi * 125.0;
  for (const double pitch : {2.0, 1.0, 0.5, 0.25, 0.125, 0.0625}) {
    const auto dexels = TriDexel::sample(kBall, kBallBox, Mm{pitch});
    ASSERT_TRUE(dexels);
    EXPECT_LT(std::abs(dexels->volume() - exact), 6.0 * pitch * pitch) << pitch;
    for (const double volume : dexels->volumes()) {
      EXPECT_LT(std::abs(volume - exact), 8.0 * pitch * pitch) << pitch;
    }
  }
}

TEST(TriDexel, HasTheSameBitsForAnyNumberOfThreads) {
  const auto sample_on = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return TriDexel::sample(kBall, kBallBox, Mm{0.3}).value();
  };
  const TriDexel one = sample_on(1);
  for (const std::size_t threads : {2U, 8U}) {
    const TriDexel many = sample_on(threads);
    EXPECT_EQ(one.interval_count(), many.interval_count());
    EXPECT_EQ(one.volumes(), many.volumes());
  }
}

TEST(TriDexel, RefusesAPitchThatIsNoLength) {
  for (const double pitch : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto dexels = TriDexel::sample(kBall, kBallBox, Mm{pitch});
    ASSERT_FALSE(dexels);
    EXPECT_THAT(dexels.error()[0].message, HasSubstr("pitch"));
  }
}

TEST(TriDexel, NamesTheLeastPitchThatFits) {
  const auto dexels = TriDexel::sample(kBall, kBallBox, Mm{1e-4});
  ASSERT_FALSE(dexels);
  EXPECT_THAT(dexels.error()[0].message, HasSubstr("rays"));
  EXPECT_THAT(dexels.error()[0].hint, HasSubstr("0.00"));
  EXPECT_FALSE(TriDexel::sample(kBall, kBallBox, Mm{1e-300}));
}

TEST(TriDexel, RefusesAnEmptyBox) {
  EXPECT_FALSE(TriDexel::sample(kBall, {Vec3::Zero(), Vec3(1.0, 1.0, 0.0)}, Mm{0.1}));
}

}  // namespace
}  // namespace frustum::stock

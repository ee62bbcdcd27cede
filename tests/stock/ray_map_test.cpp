// Maps of parallel rays say of each ray, bit for bit, what the workpiece says of it alone.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstddef>

#include "core/units.hpp"
#include "stock/dexel/tri_dexel.hpp"
#include "stock/solid/program_state.hpp"
#include "tests/law_count.hpp"
#include "tests/stock/mapped_parts.hpp"
#include "tests/stock/random_cuts.hpp"

namespace frustum::stock {
namespace {

using testing::cone;
using testing::hub;
using testing::kFlat;
using testing::kHollow;

// Offers single rays alone.
struct RayByRay {
  const WorkpieceAt& part;
  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return part.material_along(ray, span);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return part.surface_at(ray, s, tag);
  }
};

// Rays that differ, of all rays of the three families.
std::size_t different_rays(const TriDexel& a, const TriDexel& b) {
  std::size_t different = 0;
  const DexelGrid& grid = a.grid();
  for (int axis = 0; axis < 3; ++axis) {
    for (int u = 0; u < grid.nodes[static_cast<std::size_t>((axis + 1) % 3)]; ++u) {
      for (int v = 0; v < grid.nodes[static_cast<std::size_t>((axis + 2) % 3)]; ++v) {
        if (!std::ranges::equal(a.material(axis, u, v), b.material(axis, u, v))) ++different;
      }
    }
  }
  return different;
}

std::size_t different_rays(const WorkpieceAt& part, double pitch) {
  const BoundingBox box = part.workpiece().blank().bounds();
  const auto map = TriDexel::sample(part, box, Mm{pitch});
  const auto single = TriDexel::sample(RayByRay{part}, box, Mm{pitch});
  return different_rays(*map, *single);
}

TEST(RayMap, IsBitForBitThatOfSingleRaysOnTheCone) {
  const Workpiece part = cone(kFlat);
  EXPECT_EQ(different_rays(WorkpieceAt(part), 0.7), 0U);
}

TEST(RayMap, IsBitForBitThatOfSingleRaysOnTheBladedHub) {
  const Workpiece part = hub();
  EXPECT_EQ(different_rays(WorkpieceAt(part), 3.1), 0U);
}

TEST(RayMap, IsBitForBitThatOfSingleRaysForAHollowEndMill) {
  const Workpiece part = cone(kHollow);
  EXPECT_EQ(different_rays(WorkpieceAt(part), 3.0), 0U);
}

TEST(RayMap, IsBitForBitThatOfSingleRaysOnceAPartOfTheProgramHasCut) {
  const Workpiece part = hub();
  ProgramState half = end_of(part.removed().path());
  half.segments /= 2;
  EXPECT_EQ(different_rays(WorkpieceAt(part, half), 3.1), 0U);
}

TEST(RayMap, HasTheSameBitsForOneTwoAndEightThreads) {
  const Workpiece part = hub();
  const auto sampled = [&](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    return *TriDexel::sample(part, part.blank().bounds(), Mm{2.9});
  };
  const TriDexel one = sampled(1);
  EXPECT_EQ(different_rays(one, sampled(2)), 0U);
  EXPECT_EQ(different_rays(one, sampled(8)), 0U);
}

TEST(RayMapLaws, IsBitForBitThatOfSingleRaysForRandomPrograms) {
  const int programs = proof::law_count(200, 20);
  std::size_t intervals = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(programs); ++seed) {
    const proof::RandomCut cut = proof::random_cut(seed);
    const auto swept = cutter::SweptCutter::sweep(cut.path, cut.tools);
    ASSERT_TRUE(swept.has_value());
    const Workpiece part(cut.blank, *swept);
    EXPECT_EQ(different_rays(WorkpieceAt(part), 2.0 * cut.pitch), 0U) << "seed " << seed;
    intervals += TriDexel::sample(part, cut.blank.bounds(), Mm{4.0 * cut.pitch})->interval_count();
  }
  EXPECT_GT(intervals, 0U);
}

}  // namespace
}  // namespace frustum::stock

// Maps of parallel rays say of each ray, bit for bit, what the workpiece says of it alone.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/units.hpp"
#include "stock/dexel/tri_dexel.hpp"
#include "stock/solid/program_state.hpp"
#include "tests/cutter/random_paths.hpp"
#include "tests/law_count.hpp"
#include "tests/stock/random_cuts.hpp"

namespace frustum::stock {
namespace {

using cutter::Cutter;
using cutter::CutterType;
using kinematics::ToolPath;
using kinematics::ToolPose;

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

void add_block(ToolPath& path, const std::vector<ToolPose>& poses, int tool) {
  const auto block = static_cast<std::uint32_t>(path.blocks.size());
  path.blocks.push_back({.source_line = block + 1, .tool = tool});
  for (const ToolPose& pose : poses) {
    path.poses.push_back(pose);
    if (&pose == &poses.front()) continue;
    path.segments.push_back({static_cast<std::uint32_t>(path.poses.size() - 2), block});
  }
}

Cutter tool(const cutter::CutterSpec& spec) { return *Cutter::make(spec); }

// A cone of 15 degrees half angle, milled by the flank, in one round of many segments.
ToolPath cone_path(int segments) {
  constexpr double kHalfAngle = 15.0 * kRadPerDeg, kGround = 15.0, kRadius = 3.0;
  std::vector<ToolPose> poses;
  for (int i = 0; i <= segments; ++i) {
    const double phi = 2.0 * std::numbers::pi * (i % segments) / segments;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 normal = std::cos(kHalfAngle) * out + std::sin(kHalfAngle) * Vec3::UnitZ();
    const Vec3 up = std::cos(kHalfAngle) * Vec3::UnitZ() - std::sin(kHalfAngle) * out;
    poses.push_back({kGround * out + kRadius * normal + up, up});
  }
  ToolPath path;
  add_block(path, poses, 1);
  return path;
}
Workpiece cone(const cutter::CutterSpec& spec) {
  return {*Blank::make(BoxShape{40, 40, 12}, Vec3::Zero()),
          *cutter::SweptCutter::sweep(cone_path(720), {{1, tool(spec)}})};
}

// A hub with channels in five axes, the tool on the normal of the hub, and a bore along its axis.
Workpiece hub() {
  ToolPath path;
  add_block(path, {{{0, 0, 50}, Vec3::UnitZ()}, {{0, 0, -6}, Vec3::UnitZ()}}, 2);
  for (int channel = 0; channel < 4; ++channel) {
    for (int row = -2; row <= 2; ++row) {
      std::vector<ToolPose> poses;
      for (int i = 0; i <= 120; ++i) {
        const double s = 0.5 * std::numbers::pi * i / 120.0;
        const double phi = 0.5 * std::numbers::pi * channel + 0.12 * row + 0.3 * s;
        const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
        const Vec3 normal = std::cos(s) * out + std::sin(s) * Vec3::UnitZ();
        poses.push_back({(16.0 + 30.0 * (1.0 - std::cos(s))) * out +
                             (40.0 - 36.0 * std::sin(s)) * Vec3::UnitZ(),
                         normal});
      }
      add_block(path, poses, 1);
    }
  }
  return {*Blank::make(FrustumShape{52, 27, 44}, Vec3::Zero()),
          *cutter::SweptCutter::sweep(path, {{1, tool({.type = CutterType::taper_ball,
                                                       .diameter = {6},
                                                       .length = {140},
                                                       .flute_length = {40},
                                                       .taper_angle = 2.0_deg})},
                                             {2, tool({.type = CutterType::drill,
                                                       .diameter = {14},
                                                       .length = {140},
                                                       .flute_length = {70},
                                                       .tip_angle = 140.0_deg})}})};
}

const cutter::CutterSpec kFlat{
    .type = CutterType::flat, .diameter = {6}, .length = {100}, .flute_length = {15}};
const cutter::CutterSpec kHollow{.type = CutterType::bull,
                                 .diameter = {6},
                                 .length = {100},
                                 .flute_length = {15},
                                 .corner_radius = {1},
                                 .end_angle = 3.0_deg};

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

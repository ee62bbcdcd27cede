#include "cutter/search/swept_cutter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {
namespace {

using kinematics::PathBlock;
using kinematics::PathSegment;
using kinematics::ToolPath;

Cutter end_mill(CutterType type, double diameter = 12.0, double flutes = 30.0) {
  auto made = Cutter::make(
      {.type = type, .diameter = {diameter}, .length = {100.0}, .flute_length = {flutes}});
  EXPECT_TRUE(made);
  return *made;
}

ToolPath path_through(const std::vector<ToolPose>& poses) {
  ToolPath path;
  path.poses = poses;
  path.blocks = {PathBlock{.source_line = 1, .tool = 1}};
  for (std::uint32_t i = 0; i + 1 < poses.size(); ++i) path.segments.push_back({i, 0});
  return path;
}

SweptCutter sweep(CutterType type, const std::vector<ToolPose>& poses) {
  auto swept = SweptCutter::sweep(path_through(poses), {{1, end_mill(type)}});
  EXPECT_TRUE(swept);
  return *swept;
}

double draw(std::uint32_t seed, std::uint64_t index, double lo, double hi) {
  return lo + (hi - lo) * uniform({.seed = seed}, index);
}

Vec3 random_direction(std::uint32_t seed, std::uint64_t index) {
  const double z = draw(seed, index, -1.0, 1.0);
  const double a = draw(seed, index + 1, 0.0, 2.0 * std::numbers::pi);
  return Vec3(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z)
      .normalized();
}

// Union of `n` cutters standing still between times t0 and t1 of the segment.
IntervalSet standing_cutters(const Profile& profile, const ToolPose& from, const ToolPose& to,
                             const Ray& ray, int n, double t0 = 0.0, double t1 = 1.0) {
  std::vector<Interval> all;
  for (int i = 0; i <= n; ++i) {
    const double t = t0 + (t1 - t0) * i / n;
    const auto chord = profile.chord(kinematics::between(from, to, t), ray);
    if (chord) all.push_back({chord->lo, chord->hi, i, i});
  }
  return IntervalSet(std::move(all));
}

// 20,000 cutters over the segment leave steps of their own spacing where an edge of the cutter does
// the cutting; 20,000 more around the one that made each end remove them.
IntervalSet brute_force_union(const Profile& profile, const ToolPose& from, const ToolPose& to,
                              const Ray& ray) {
  constexpr int kCutters = 20000;
  IntervalSet all = standing_cutters(profile, from, to, ray, kCutters);
  for (const Interval& coarse : std::vector(all.intervals().begin(), all.intervals().end())) {
    for (const EndTag tag : {coarse.lo_tag, coarse.hi_tag}) {
      const double t0 = std::max(0.0, (static_cast<double>(tag) - 1) / kCutters);
      const double t1 = std::min(1.0, (static_cast<double>(tag) + 1) / kCutters);
      all = all.united(standing_cutters(profile, from, to, ray, kCutters, t0, t1));
    }
  }
  // What the finer cutters add may stand a fraction of a coarse step away; such slits are closed.
  constexpr double kSlit = 1e-6;  // mm
  std::vector<Interval> closed(all.intervals().begin(), all.intervals().end());
  for (Interval& i : closed) i.hi += kSlit;
  const IntervalSet joined(closed);
  closed.assign(joined.intervals().begin(), joined.intervals().end());
  for (Interval& i : closed) i.hi -= kSlit;
  return IntervalSet(closed);
}

// How far the two sets differ, measured normal to the swept surface at each end.
double normal_difference(const SweptCutter& swept, const Ray& ray, const IntervalSet& exact,
                         const IntervalSet& brute) {
  if (exact.intervals().size() != brute.intervals().size()) return 1e3;
  double worst = 0.0;
  for (std::size_t i = 0; i < exact.intervals().size(); ++i) {
    const Interval& a = exact.intervals()[i];
    const Interval& b = brute.intervals()[i];
    const Vec3 n_lo = swept.contact(ray, a.lo, static_cast<std::uint32_t>(a.lo_tag)).normal;
    const Vec3 n_hi = swept.contact(ray, a.hi, static_cast<std::uint32_t>(a.hi_tag)).normal;
    worst = std::max(worst, std::abs((a.lo - b.lo) * n_lo.dot(ray.direction)));
    worst = std::max(worst, std::abs((a.hi - b.hi) * n_hi.dot(ray.direction)));
  }
  return worst;
}

class BothCutters : public testing::TestWithParam<CutterType> {};

TEST_P(BothCutters, AgreesWithTwentyThousandStandingCuttersOnRandomRaysThroughAFiveAxisMove) {
  const ToolPose from{Vec3(-2, 1, 0), Vec3(0.3, -0.2, 1.0).normalized()};
  const ToolPose to{Vec3(2.5, -0.5, 0.8), Vec3(-0.1, 0.4, 1.0).normalized()};
  const SweptCutter swept = sweep(GetParam(), {from, to});
  const Profile& profile = swept.tool(1).body().parts().front();
  double worst = 0.0;
  int met = 0, short_cords = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    const Vec3 aim(draw(3, 5 * k, -9, 9), draw(3, 5 * k + 1, -9, 9), draw(3, 5 * k + 2, -4, 32));
    const Ray ray{aim - 60.0 * random_direction(4, 2 * k), random_direction(4, 2 * k)};
    const IntervalSet exact = swept.along(ray, {0.0, 120.0});
    const IntervalSet brute = brute_force_union(profile, from, to, ray);
    if (exact.length() < 1e-3 && exact.intervals().size() != brute.intervals().size()) {
      // A ray that only grazes: how deep it enters decides, not whether it does.
      ++short_cords;
      continue;
    }
    worst = std::max(worst, normal_difference(swept, ray, exact, brute));
    met += exact.empty() ? 0 : 1;
  }
  EXPECT_LT(worst, 1e-6);  // 1 nm
  EXPECT_GT(met, 200);
  EXPECT_LE(short_cords, 2);
  RecordProperty("worst_nm", std::to_string(worst * 1e6));
}

TEST_P(BothCutters, NeverMissesWhatAStandingCutterCovers) {
  // Rays that hardly touch: aimed at points near the generatrix of the sweep.
  const ToolPose from{Vec3(0, 0, 0), Vec3::UnitZ()};
  const ToolPose to{Vec3(30, 5, 1), rotation_y(0.3) * Vec3::UnitZ()};
  const SweptCutter swept = sweep(GetParam(), {from, to});
  const Profile& profile = swept.tool(1).body().parts().front();
  for (std::uint32_t k = 0; k < 3000; ++k) {
    const ToolPose at = kinematics::between(from, to, uniform({.seed = 9}, k));
    const Vec3 d = random_direction(10, 2 * k);
    const Vec3 out = d.cross(random_direction(11, 2 * k)).normalized();
    // The plane along d with normal `out` that touches the cutter there, moved inwards a little.
    const double depth = std::pow(10.0, draw(12, k, -5.0, 0.0));
    const double height = profile.support(out.dot(at.axis)) - depth;
    const Vec3 aim = at.tip + height * out + draw(13, k, -5.0, 5.0) * out.cross(d);
    const Ray ray{aim - 50.0 * d, d};
    const auto chord = profile.chord(at, ray);
    const IntervalSet exact = swept.along(ray, {0.0, 100.0});
    if (!chord || chord->hi < 0.0 || chord->lo > 100.0) continue;
    const double lo = std::max(0.0, chord->lo), hi = std::min(100.0, chord->hi);
    ASSERT_TRUE(exact.covers(lo + 1e-9, hi - 1e-9) || hi - lo < 3e-9) << k << " depth " << depth;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BothCutters, testing::Values(CutterType::flat, CutterType::ball),
                         [](const auto& each) { return to_string(each.param); });

// A thin disc that turns past the ray between two poses that just clear it, by a nanometre.
TEST(SweptCutterLaws, WhatTurningBringsInBetweenTwoClearPosesIsFound) {
  constexpr double kRadius = 25.0, kHeight = 1.0, kTurn = 0.0499, kClear = 1e-6;
  auto disc = Cutter::make({.type = CutterType::flat,
                            .diameter = {2.0 * kRadius},
                            .length = {kHeight},
                            .flute_length = {kHeight}});
  ASSERT_TRUE(disc);
  const double wall = kRadius + kClear;
  const double bend = disc->body().reach() * kTurn * kTurn / 8.0;
  const double end = wall - (kRadius * std::cos(kTurn) + kHeight * std::sin(kTurn)) - bend - kClear;
  const std::vector<ToolPose> poses{
      {Vec3::Zero(), Vec3::UnitZ()},
      {Vec3(end, 0.0, 0.0), Vec3(std::sin(kTurn), 0.0, std::cos(kTurn))}};
  const auto swept = SweptCutter::sweep(path_through(poses), {{1, *disc}});
  ASSERT_TRUE(swept);
  int found = 0;
  for (int k = 0; k <= 100; ++k) {
    const Ray ray{{wall, -30.0, 0.01 * k}, Vec3::UnitY()};
    double deepest = 0.0;
    const SegmentMotion motion(poses[0], poses[1], disc->body().reach());
    for (int i = 0; i <= 1000; ++i) {
      const auto chord = disc->body().parts().front().chord(motion.at(i / 1000.0), ray);
      if (!chord) continue;
      const Vec3 middle = ray.at(0.5 * (chord->lo + chord->hi));
      deepest = std::max(deepest, -disc->body().distance(motion.at(i / 1000.0), middle));
    }
    if (swept->along(ray, {0.0, 60.0}).intervals().empty()) {
      EXPECT_LT(deepest, 1e-6) << k;
    } else {
      ++found;
    }
  }
  EXPECT_GT(found, 5);
}

TEST(SweptCutter, HalfTurnsAreRefusedAndNearlyHalfTurnsAreNot) {
  const std::map<int, Cutter> tools{{1, end_mill(CutterType::ball)}};
  ToolPath path = path_through({{Vec3::Zero(), Vec3::UnitZ()}, {Vec3::Zero(), -Vec3::UnitZ()}});
  path.blocks.front().source_line = 7;
  const auto refused = SweptCutter::sweep(path, tools);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().line, 7);
  path.poses.back().axis = Vec3(1e-3, 0.0, -1.0).normalized();
  const auto swept = SweptCutter::sweep(path, tools);
  ASSERT_TRUE(swept);
  // Half a disc of flutes: the shaft's upper end passes along +X.
  const auto cover = swept->along({{0.0, 0.0, 6.0}, Vec3::UnitX()}, {0.0, 100.0});
  ASSERT_EQ(cover.intervals().size(), 1U);
  EXPECT_TRUE(std::isfinite(cover.intervals().front().hi));
  EXPECT_GT(cover.intervals().front().hi, 20.0);
}

TEST(SweptCutter, CutsASlotThatIsABoxAndTwoHalfCylinders) {
  const SweptCutter slot =
      sweep(CutterType::flat, {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(40, 0, 0), Vec3::UnitZ()}});
  const auto length = [&](const Vec3& from, const Vec3& along) {
    return slot.along({from, along}, {-100.0, 200.0}).length();
  };
  EXPECT_NEAR(length(Vec3(20, -50, 1), Vec3::UnitY()), 12.0, 1e-12);
  EXPECT_NEAR(length(Vec3(-50, 0, 1), Vec3::UnitX()), 52.0, 1e-9);
  EXPECT_NEAR(length(Vec3(-50, 3, 1), Vec3::UnitX()), 40.0 + 2.0 * std::sqrt(36.0 - 9.0), 1e-9);
  EXPECT_NEAR(length(Vec3(20, 1, -50), Vec3::UnitZ()), 30.0, 1e-12);
}

TEST(SweptCutter, HandlesPlungeDwellAndPureRotation) {
  const Ray across{Vec3(-50, 1.0, 5.0), Vec3::UnitX()};
  const double chord = 2.0 * std::sqrt(35.0);
  const SweptCutter plunge =
      sweep(CutterType::flat, {{Vec3(0, 0, 20), Vec3::UnitZ()}, {Vec3(0, 0, 0), Vec3::UnitZ()}});
  EXPECT_NEAR(plunge.along(across, {0, 100}).length(), chord, 1e-9);
  EXPECT_NEAR(plunge.along({Vec3(0, 1, -50), Vec3::UnitZ()}, {0, 150}).length(), 50.0, 1e-9);
  const SweptCutter dwell =
      sweep(CutterType::flat, {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(0, 0, 0), Vec3::UnitZ()}});
  EXPECT_NEAR(dwell.along(across, {0, 100}).length(), chord, 1e-12);
  // Turning about the tip by 0.5 rad, the cutter's side reaches lowest at the end of the turn.
  const SweptCutter turn =
      sweep(CutterType::flat,
            {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(0, 0, 0), rotation_y(0.5) * Vec3::UnitZ()}});
  const IntervalSet below = turn.along({Vec3(5.5, 0, -50), Vec3::UnitZ()}, {0, 50});
  ASSERT_FALSE(below.empty());
  EXPECT_NEAR(50.0 - below.intervals().front().lo, (6.0 - 5.5 * std::cos(0.5)) / std::sin(0.5),
              1e-9);
}

TEST(SweptCutter, FindsRaysThatRunInTheMachinedFloor) {
  const SweptCutter slot =
      sweep(CutterType::flat, {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(80, 0, 0), Vec3::UnitZ()}});
  for (const double z : {-1e-3, -1e-7, -1e-9, 0.0, 1e-9, 1e-7}) {
    const IntervalSet met = slot.along({Vec3(-50, 0.5, z), Vec3::UnitX()}, {0.0, 200.0});
    EXPECT_EQ(met.empty(), z < 0.0) << z;
  }
}

TEST(SweptCutter, DishOfATiltedEndFaceIsAnEllipse) {
  // The end face, tilted by delta across the feed, leaves an elliptic trough of depth R |sin
  // delta|.
  const double delta = 0.02;
  const Vec3 axis = rotation_y(delta) * Vec3::UnitZ();  // leans into the feed direction X
  const SweptCutter cut =
      sweep(CutterType::flat, {{Vec3(-60, 0, 0), axis}, {Vec3(60, 0, 0), axis}});
  for (const double y : {0.0, 2.0, 4.0, 5.5}) {
    const IntervalSet up = cut.along({Vec3(0, y, -20), Vec3::UnitZ()}, {0.0, 40.0});
    ASSERT_FALSE(up.empty());
    const double depth = 20.0 - up.intervals().front().lo;
    EXPECT_NEAR(depth, std::sin(delta) * std::sqrt(36.0 - y * y), 1e-9) << y;
  }
}

TEST(SweptCutter, RefusesAPathWithAToolThatIsNotDefined) {
  ToolPath path = path_through({{Vec3::Zero(), Vec3::UnitZ()}, {Vec3::UnitX(), Vec3::UnitZ()}});
  path.blocks[0].tool = 7;
  const auto swept = SweptCutter::sweep(path, {{1, end_mill(CutterType::flat)}});
  ASSERT_FALSE(swept);
  EXPECT_NE(swept.error().front().message.find("T7"), std::string::npos);
}

}  // namespace
}  // namespace frustum::cutter

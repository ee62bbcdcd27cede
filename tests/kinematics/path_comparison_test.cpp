// Paths that go back over themselves are matched there and back.
#include "kinematics/path/path_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace frustum::kinematics {
namespace {

// One block of feed moves through these places, with 1 s per mm.
ToolPath path_through(std::span<const Vec3> places) {
  ToolPath path;
  path.blocks.push_back({.kind = PathKind::feed});
  double time = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) {
      time += (places[i] - places[i - 1]).norm();
      path.segments.push_back({.first_pose = static_cast<std::uint32_t>(i - 1), .block = 0});
    }
    path.poses.push_back({.tip = places[i], .axis = Vec3::UnitZ()});
    path.times.push_back(time);
  }
  return path;
}

// From x = 0 to `far` and back.
std::vector<Vec3> there_and_back(double far, double step, double y_there, double y_back) {
  std::vector<Vec3> places;
  const int n = static_cast<int>(std::lround(far / step));
  for (int i = 0; i <= n; ++i) places.emplace_back(i * step, y_there, 0.0);
  for (int i = n - 1; i >= 0; --i) places.emplace_back(i * step, y_back, 0.0);
  return places;
}

double farthest_tip(const PathMatches& found) {
  double farthest = 0.0;
  for (const PathMatch& match : found.matches) {
    farthest = std::max(farthest, match.tip_distance());
  }
  return farthest;
}

TEST(PathComparison, AReversalIsPassedOnceWhereTheWayBackIsTheNearerOne) {
  // There by 3 um beside, back by 1 um.
  const auto reference = path_through(there_and_back(10.0, 0.01, 0.0, 0.0));
  const auto other = path_through(there_and_back(10.0, 0.01, 0.003, 0.001));
  const PathMatches found = match_paths(reference, other);
  ASSERT_EQ(found.matches.size(), reference.poses.size());
  for (const PathMatch& match : found.matches) {
    EXPECT_NEAR(match.other.time, match.reference.time, 0.005);
  }
  EXPECT_NEAR(farthest_tip(found), 0.003, 1e-9);
}

TEST(PathComparison, AnAxisThatTakesUpItsJumpAtAReversalIsNoDifference) {
  // At x = 1 the other tool goes 12.5 um aside and back; the reference has poses close together.
  const auto reference = path_through(there_and_back(1.0, 1e-3, 0.0, 0.0));
  std::vector<Vec3> places = there_and_back(1.0, 1e-3, 0.0, 0.0);
  places.insert(places.begin() + 1'001, {Vec3(1.0, 0.0125, 0.0), Vec3(1.0, 0.0, 0.0)});
  const PathMatches found = match_paths(reference, path_through(places));
  EXPECT_LT(farthest_tip(found), 1e-6);
  EXPECT_EQ(found.left_over, 0.0);
}

TEST(PathComparison, AnAxisThatTurnsToAndFroOnTheWayIsNoDifference) {
  // 200 times 8 um aside and back on the first millimetre: 3.2 mm of way.
  std::vector<Vec3> places;
  for (int i = 0; i < 200; ++i) {
    places.emplace_back(i * 0.005, 0.0, 0.0);
    places.emplace_back(i * 0.005, 0.008, 0.0);
    places.emplace_back(i * 0.005, 0.0, 0.0);
  }
  places.emplace_back(10.0, 0.0, 0.0);
  std::vector<Vec3> straight;
  for (int x = 0; x <= 10; ++x) straight.emplace_back(x, 0.0, 0.0);
  const PathMatches found = match_paths(path_through(straight), path_through(places));
  EXPECT_LT(farthest_tip(found), 1e-9);
}

TEST(PathComparison, ASecondPassIsLeftOver) {
  const auto once = there_and_back(10.0, 0.1, 0.0, 0.0);
  std::vector<Vec3> twice = once;
  twice.insert(twice.end(), once.begin() + 1, once.end());
  const PathMatches found = match_paths(path_through(once), path_through(twice));
  EXPECT_LT(farthest_tip(found), 1e-9);
  EXPECT_NEAR(found.left_over, 20.0, 1e-9);
  // And one that is missing is 10 mm away at its far end.
  EXPECT_NEAR(farthest_tip(match_paths(path_through(twice), path_through(once))), 10.0, 1e-9);
}

}  // namespace
}  // namespace frustum::kinematics

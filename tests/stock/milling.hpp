// Small cut workpieces for tests: a box, end mills, and programs written as lists of tool
// positions.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "core/random.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock::testing {

inline cutter::Cutter end_mill(double diameter = 10.0, double flutes = 30.0,
                               cutter::CutterType type = cutter::CutterType::flat) {
  auto made = cutter::Cutter::make(
      {.type = type, .diameter = {diameter}, .length = {100.0}, .flute_length = {flutes}});
  EXPECT_TRUE(made);
  return *made;
}

// Block i goes from pose i to pose i + 1, is on line 10 (i + 1) and takes 10 s.
inline kinematics::ToolPath path_through(const std::vector<kinematics::ToolPose>& poses) {
  kinematics::ToolPath path;
  path.poses = poses;
  for (std::uint32_t i = 0; i + 1 < poses.size(); ++i) {
    path.blocks.push_back(
        {.source_line = 10 * (i + 1), .tool = 1, .feed = 600.0, .duration = 10.0});
    path.segments.push_back({i, i});
  }
  return path;
}

inline kinematics::ToolPath path_through(const std::vector<Vec3>& tips) {
  std::vector<kinematics::ToolPose> poses;
  for (const Vec3& tip : tips) poses.push_back({tip, Vec3::UnitZ()});
  return path_through(poses);
}

// 100 x 60 x 20 with its top at z = 0 and its middle at x = y = 0.
inline Workpiece cut(kinematics::ToolPath path, cutter::Cutter tool = end_mill()) {
  auto blank = Blank::make(BoxShape{100.0, 60.0, 20.0}, Vec3(0, 0, -20));
  EXPECT_TRUE(blank);
  auto swept = cutter::SweptCutter::sweep(std::move(path), {{1, std::move(tool)}});
  EXPECT_TRUE(swept);
  return Workpiece(*std::move(blank), *std::move(swept));
}

// Five-axis motion all over the box, in and out of it.
inline kinematics::ToolPath random_path(std::uint32_t seed, int blocks) {
  std::vector<kinematics::ToolPose> poses;
  for (int i = 0; i <= blocks; ++i) {
    const auto draw = [&](std::uint64_t k, double lo, double hi) {
      return lo + (hi - lo) * uniform({.seed = seed}, static_cast<std::uint64_t>(8 * i) + k);
    };
    const Vec3 tip(draw(0, -55, 55), draw(1, -35, 35), draw(2, -12, 6));
    poses.push_back({tip, Vec3(draw(3, -0.4, 0.4), draw(4, -0.4, 0.4), 1.0).normalized()});
  }
  return path_through(poses);
}

}  // namespace frustum::stock::testing

#include "trials/population/near_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kinematics/model/tool_pose.hpp"
#include "tests/stock/milling.hpp"

namespace frustum::trials {
namespace {

using stock::testing::end_mill;
using stock::testing::random_path;

// Two tools, and a jump from pose to pose where one takes over.
kinematics::ToolPath path_of_two_tools() {
  constexpr std::uint32_t kBlocks = 240, kSecond = 130;
  kinematics::ToolPath path = random_path(17, kBlocks);
  for (std::uint32_t i = 0; i < kBlocks; ++i) path.blocks[i].tool = i < kSecond ? 1 : 2;
  path.segments.erase(path.segments.begin() + kSecond);
  return path;
}

TEST(NearSegments, PassOverNoneThatComesNear) {
  const kinematics::ToolPath path = path_of_two_tools();
  const auto removed = cutter::SweptCutter::sweep(
      path, {{1, end_mill(10.0, 30.0, cutter::CutterType::ball)}, {2, end_mill(4.0)}});
  ASSERT_TRUE(removed);
  const NearSegments segments(*removed);
  std::size_t visits = 0, near_by = 0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto draw = [&](std::uint64_t k, double most) {
      return most * (2.0 * uniform({.seed = 23}, 4 * i + k) - 1.0);
    };
    const Vec3 point(draw(0, 50.0), draw(1, 30.0), draw(2, 15.0));
    const double within = i % 2 == 0 ? 0.05 : 4.0;
    std::set<std::uint32_t> visited;
    segments.for_each(point, within, [&](std::uint32_t s) { return visited.insert(s).second; });
    visits += visited.size();
    for (std::uint32_t s = 0; s < path.segments.size(); ++s) {
      const kinematics::PathSegment& segment = path.segments[s];
      const cutter::Body& body = removed->tool(path.blocks[segment.block].tool).body();
      double least = within + 1.0;
      for (int k = 0; k <= 64; ++k) {
        const auto pose = kinematics::between(path.from(segment), path.to(segment), k / 64.0);
        least = std::min(least, body.distance(pose, point));
      }
      if (least > within) continue;
      ++near_by;
      EXPECT_TRUE(visited.contains(s)) << "point " << i << ", segment " << s;
    }
  }
  EXPECT_GT(near_by, 1000U);
  EXPECT_LT(visits, 100 * path.segments.size() / 2);
}

}  // namespace
}  // namespace frustum::trials

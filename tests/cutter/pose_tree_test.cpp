// What a group says of its poses holds of each of them, whatever the path and however long.
#include "cutter/search/pose_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cutter/search/axis_distance.hpp"
#include "cutter/search/swept_cutter.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::PoseGroup;
using cutter::PoseTree;
using kinematics::ToolPath;
using kinematics::ToolPose;

// So many segments that go on from each other and turn by up to `turn` (rad) each.
ToolPath winding_path(Draw& draw, int segments, double turn) {
  std::vector<ToolPose> poses{
      {draw.point(Vec3::Constant(-50.0), Vec3::Constant(50.0)), draw.direction()}};
  for (int i = 0; i < segments; ++i) {
    const ToolPose& last = poses.back();
    poses.push_back({last.tip + draw.between(0.0, 2.0) * draw.direction(),
                     (last.axis + draw.between(0.0, turn) * draw.direction()).normalized()});
  }
  return path_through(poses);
}

std::vector<std::uint32_t> all_of(const ToolPath& path) {
  std::vector<std::uint32_t> all(path.segments.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

constexpr double kRounding = 1e-12;  // mm

void expect_holds(const PoseGroup& group, const ToolPose& pose) {
  const Mat3 to_frame = group.frame.inverse();
  const Vec3 tip = to_frame * (pose.tip - group.middle.tip);
  const Vec3 axis = to_frame * (pose.axis - group.middle.axis);
  EXPECT_TRUE((tip.cwiseAbs().array() <= group.tip_half.array() + kRounding).all())
      << (tip.cwiseAbs() - group.tip_half).transpose();
  EXPECT_TRUE((axis.cwiseAbs().array() <= group.axis_half.array() + kRounding).all())
      << (axis.cwiseAbs() - group.axis_half).transpose();
  EXPECT_LE((pose.axis - group.middle.axis).norm(), group.axis_shift + kRounding);
}

struct Tree {
  const ToolPath& path;
  const cutter::Body& body;
  PoseTree tree{path, all_of(path), body};
  std::vector<int> times = std::vector<int>(path.segments.size(), 0);

  // Every segment under a group, each of which is held by all groups over it.
  std::vector<std::uint32_t> check(std::uint32_t index) {
    const PoseGroup group = tree.group(index);
    std::vector<std::uint32_t> under;
    if (group.count > 0) {
      EXPECT_LE(group.count, cutter::kMostInLeaf);
      const auto own = tree.segments().subspan(group.first, group.count);
      under.assign(own.begin(), own.end());
      for (const std::uint32_t i : own) ++times[i];
    } else {
      for (std::uint32_t k = 0; k < cutter::kSiblings; ++k) {
        if (tree.is_free(group.children + k)) continue;
        const auto more = check(group.children + k);
        under.insert(under.end(), more.begin(), more.end());
      }
    }
    EXPECT_EQ(group.earliest, *std::ranges::min_element(under));
    for (const std::uint32_t i : under) {
      const cutter::SegmentMotion motion(path, path.segments[i], body.reach());
      for (const double t : {0.0, 0.3, 0.5, 1.0}) expect_holds(group, motion.at(t));
    }
    return under;
  }
};

TEST(PoseTree, HoldsEverySegmentOnceAndAllPosesInTheBoxesOfTheirGroups) {
  const cutter::Body& body = kind_named("flat").cutter.body();
  Draw draw(5);
  for (const int segments : {1, 2, 4, 5, 16, 17, 31, 64, 65, 113, 257, 1000}) {
    for (const double turn : {0.0, 0.01, 0.5}) {
      SCOPED_TRACE(testing::Message() << segments << " segments, " << turn << " rad");
      const ToolPath path = winding_path(draw, segments, turn);
      Tree tree{path, body};
      EXPECT_EQ(tree.check(0).size(), path.segments.size());
      EXPECT_TRUE(std::ranges::all_of(tree.times, [](int times) { return times == 1; }));
    }
  }
}

// Quads of leaves are filled: so many quads and no more.
TEST(PoseTree, FillsTheLowerGroups) {
  const cutter::Body& body = kind_named("flat").cutter.body();
  Draw draw(6);
  const ToolPath path = winding_path(draw, 7200, 0.001);
  const PoseTree tree(path, all_of(path), body);
  // 450 quads of leaves; over them each has three or four under it but for the uppermost.
  EXPECT_LE(tree.quads().size(), 450U * 3 / 2);
}

// So thin that nothing but its axis says where it is.
cutter::Cutter slender_mill(double flutes) {
  return *cutter::Cutter::make({.type = cutter::CutterType::flat,
                                .diameter = {0.4},
                                .length = {flutes + 20.0},
                                .flute_length = {flutes}});
}

// Slender cutters that swing, so that the axis in the middle is far from a unit.
TEST(AxisDistance, NeverLeavesACutterAsideThatIsThere) {
  const cutter::Cutter tool = slender_mill(20.0);
  const cutter::Body& body = tool.body();
  Draw draw(7);
  for (int i = 0; i < 200; ++i) {
    const double swing = draw.decades(1e-3, 1.0), way = draw.between(0.0, 30.0);
    std::vector<ToolPose> poses;
    for (int k = 0; k <= 64; ++k) {
      const double angle = swing * std::sin(0.3 * k);
      poses.push_back({Vec3(way * k / 64.0, 0.0, 0.0), {0.0, std::sin(angle), std::cos(angle)}});
    }
    const ToolPath path = path_through(poses);
    const PoseTree tree(path, all_of(path), body);
    for (int k = 0; k < 50; ++k) {
      const auto segment = static_cast<std::uint32_t>(draw.below(64));
      const ToolPose pose =
          cutter::SegmentMotion(path, path.segments[segment], body.reach()).at(draw.between(0, 1));
      const Vec3 point = pose.tip + draw.between(0.0, body.height()) * pose.axis;
      const auto leads_there = [&](auto& self, std::uint32_t index) -> bool {
        const PoseGroup group = tree.group(index);
        const auto& quad = tree.quads()[index / cutter::kSiblings];
        if (cutter::AxisDistance(point, body).are_away(quad)[index % cutter::kSiblings])
          return false;
        if (group.count > 0) {
          return std::ranges::count(tree.segments().subspan(group.first, group.count), segment) > 0;
        }
        for (std::uint32_t c = 0; c < cutter::kSiblings; ++c) {
          if (!tree.is_free(group.children + c) && self(self, group.children + c)) return true;
        }
        return false;
      };
      ASSERT_TRUE(leads_there(leads_there, 0)) << i << ' ' << k;
    }
  }
}

// Three ways that a slender cutter stands at one tip: their middle is short, and far from each.
TEST(AxisDistance, IsThatOfAShortAxisToo) {
  const cutter::Cutter tool = slender_mill(60.0);
  constexpr double kDown = -0.5528, kUp = 0.5893;
  std::vector<ToolPose> poses;
  for (int k = 0; k < 3; ++k) {
    Vec3 axis = Vec3::Constant(kUp);
    axis[k] = kDown;
    const ToolPose pose{Vec3::Zero(), axis.normalized()};
    poses.push_back(pose);
    poses.push_back(pose);
  }
  ToolPath path = path_through(poses);
  std::erase_if(path.segments,
                [](const kinematics::PathSegment& s) { return s.first_pose % 2 == 1; });
  const PoseTree tree(path, all_of(path), tool.body());
  const cutter::GroupQuad& root = tree.quads().front();
  for (const ToolPose& pose : poses) {
    for (const double height : {0.5, 10.0, 55.0, 59.9}) {
      const Vec3 point = pose.tip + height * pose.axis + 0.15 * perpendicular_to(pose.axis);
      EXPECT_FALSE(cutter::AxisDistance(point, tool.body()).are_away(root)[0]) << height;
    }
  }
}

// A cutter that leans and stands still, along its axis: the tiles know what single rays do.
TEST(PoseTree, TilesOfLeaningCuttersAreAsSingleRays) {
  const cutter::Cutter& tool = kind_named("flat").cutter;
  Draw draw(8);
  for (int i = 0; i < 150; ++i) {
    const ToolPose pose{draw.point(Vec3::Constant(-5.0), Vec3::Constant(5.0)), draw.axis(0.9)};
    const auto swept = cutter::SweptCutter::sweep(path_through({pose, pose}), {{1, tool}});
    ASSERT_TRUE(swept);
    const Vec3 one = perpendicular_to(pose.axis), two = pose.axis.cross(one);
    std::vector<Ray> rays;
    for (int k = 0; k < 256; ++k) {
      rays.push_back({pose.tip - 20.0 * pose.axis + 0.2 * ((k % 16 - 8) * one + (k / 16 - 8) * two),
                      pose.axis});
    }
    const std::vector<RaySpan> spans(rays.size(), {-100.0, 200.0});
    const auto all = swept->along_all(rays, spans, 16);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const IntervalSet alone = swept->along(rays[k], spans[k]);
      ASSERT_EQ(all[k].intervals().size(), alone.intervals().size()) << i << ' ' << k;
      ASSERT_EQ(all[k].length(), alone.length()) << i << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace frustum::proof

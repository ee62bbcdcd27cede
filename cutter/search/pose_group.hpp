// Path segments near each other in place and direction, and what bounds all their poses.
//
// Model    : every pose of the group is its middle moved by `frame` times a place within
//            +-tip_half, its axis turned by `frame` times one within +-axis_half. Groups are stored
//            by four, in single precision: the middle and the frame are what those numbers say,
//            and the bounds, rounded outward, hold from there
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm), and are as tight as single precision makes
//            them: 1e-7 of the size of the group, and of the box's coordinates
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "cutter/body/profile.hpp"
#include "cutter/search/lanes.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

struct PoseGroup {
  Box box{};  // of all that the cutter covers in these segments
  ToolPose
      middle{};  // near the middle of the poses; not on the path, and its axis not quite a unit
  Mat3 frame = Mat3::Identity();  // columns: directions of the oriented box, units within 1e-7
  Vec3 tip_half = Vec3::Zero();
  Vec3 axis_half = Vec3::Zero();
  double axis_shift = 0.0;  // no axis is farther from the middle's
  double tip_turn = 0.0;    // nor is (way of the tip) x (turn of the axis) of any pose more (mm)
  double shift = 0.0;       // nor any point of the cutter from its place at the representative (mm)
  // One of the segments: where it begins is the group's representative.
  std::uint32_t representative_segment = 0;
  std::uint32_t representative_pose = 0;  // of the path
  std::uint32_t earliest = 0;             // the first of the segments in program order
  std::uint32_t first = 0;     // a leaf's segments: PoseTree::segments(), first and count
  std::uint32_t count = 0;     // 0: not a leaf
  std::uint32_t children = 0;  // not of a leaf: the first of kSiblings groups, side by side

  [[nodiscard]] const ToolPose& representative(const kinematics::ToolPath& path) const {
    return path.poses[representative_pose];
  }
};

inline constexpr std::uint32_t kSiblings = 4;

// Groups side by side, as PoseGroup has them but for `frame`, whose third column is the cross
// product of the others. Where a place is free, `earliest` is the largest number.
struct alignas(64) GroupQuad {
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  static constexpr FloatFour kBeyond{kFar, kFar, kFar, kFar}, kBefore{-kFar, -kFar, -kFar, -kFar};
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  std::array<FloatFour, 3> box_min{kBeyond, kBeyond, kBeyond};
  std::array<FloatFour, 3> box_max{kBefore, kBefore, kBefore};
  std::array<FloatFour, 3> tip{}, axis{};  // of the middle
  std::array<FloatFour, 3> first_column{}, second_column{};
  std::array<FloatFour, 3> tip_half{}, axis_half{};
  FloatFour axis_shift{}, tip_turn{}, shift{};
  std::array<std::uint32_t, 4> representative_segment{}, representative_pose{};
  std::array<std::uint32_t, 4> earliest{kFree, kFree, kFree, kFree};
  std::array<std::uint32_t, 4> next{};   // of a leaf the first segment, else the quad of children
  std::array<std::uint16_t, 4> count{};  // 0: not a leaf

  [[nodiscard]] bool is_free(std::size_t lane) const { return earliest[lane] == kFree; }
  // Precondition: it is not free.
  [[nodiscard]] PoseGroup group(std::size_t lane) const;
};

// Largest value of x.n over all poses of the group, counted from the middle's tip.
[[nodiscard]] double support(const PoseGroup& group, const Profile& body, const Vec3& normal);

}  // namespace frustum::cutter

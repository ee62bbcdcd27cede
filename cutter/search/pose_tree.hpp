// The poses of a tool path in groups of groups, each with what bounds its sweep from one known
// pose.
//
// Model    : a group holds segments that are near each other in place and direction. All their
//            poses are in an oriented box around the representative, a pose that the path really
//            takes: the cutter there is covered for certain, and a plane that touches it there,
//            moved out by the box, bounds what all of the group covers. A group along a surface is
//            flat, so that the bound is tight: far tighter than a box of the swept volume, which
//            overlaps all its neighbours
// Units    : mm; frame: workpiece
// Shape    : a binary tree, siblings side by side, up to four segments a leaf; 160 to 310 bytes a
//            segment
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "cutter/body/profile.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

struct PoseGroup {
  Box box{};                  // of all that the cutter covers in these segments
  ToolPose representative{};  // where one of the segments begins
  std::uint32_t representative_segment = 0;
  std::uint32_t earliest = 0;     // the first of the segments in program order
  std::uint32_t first = 0;        // a leaf's segments: PoseTree::segments(), first and count
  std::uint32_t count = 0;        // 0: not a leaf
  std::uint32_t children = 0;     // not of a leaf: the first of two groups, side by side
  Mat3 frame = Mat3::Identity();  // columns: directions of the oriented box
  Vec3 tip_lo = Vec3::Zero(), tip_hi = Vec3::Zero();    // of tip - representative.tip along them
  Vec3 axis_lo = Vec3::Zero(), axis_hi = Vec3::Zero();  // of axis - representative.axis along them
  double tip_shift = 0.0;   // no tip is farther from the representative's (mm)
  double axis_shift = 0.0;  // nor any axis from its axis
  double shift = 0.0;       // nor any point of the cutter from its place at the representative (mm)
};

// Largest value of x.n over all poses of the group, counted from the representative's tip.
[[nodiscard]] double support(const PoseGroup& group, const Profile& body, const Vec3& normal);

// Largest value of v.(tip - representative.tip) over the group, and the same for axes.
[[nodiscard]] double farthest_tip(const PoseGroup& group, const Vec3& v);
[[nodiscard]] double farthest_axis(const PoseGroup& group, const Vec3& v);

class PoseTree {
 public:
  // `boxes` holds the box of every segment of the path; the tree is over `segments`. `reach`: no
  // point of the cutter is farther than this from the tip.
  PoseTree(const kinematics::ToolPath& path, std::span<const Box> boxes,
           std::vector<std::uint32_t> segments, double reach);

  // The first is the root; empty without segments.
  [[nodiscard]] std::span<const PoseGroup> groups() const { return groups_; }
  [[nodiscard]] std::span<const std::uint32_t> segments() const { return segments_; }

 private:
  std::vector<PoseGroup> groups_{};
  std::vector<std::uint32_t> segments_;
};

}  // namespace frustum::cutter

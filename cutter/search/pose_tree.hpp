// The poses of a tool path in groups of groups, each with what bounds its sweep.
//
// Model    : a group holds segments that are near each other in place and direction. All their
//            poses are in an oriented box (pose_group.hpp). Where one of its segments begins is its
//            representative: the cutter there is covered for certain, and a plane that touches a
//            cutter near there, moved out by the box, bounds what all of the group covers. A group
//            along a surface is flat, so that the bound is tight: far tighter than a box of the
//            swept volume, which overlaps all its neighbours
// Units    : mm; frame: workpiece
// Shape    : each group is halved, and the halves again: two to four siblings side by side, four in
//            the lower groups, up to four segments a leaf; 47 bytes a segment of a long program
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm)
// Threads  : built on all cores; the same bits for any number of them
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cutter/body/body.hpp"
#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

// Segments of a leaf.
inline constexpr std::uint32_t kMostInLeaf = 4;

class PoseTree {
 public:
  // Over `segments` of the path, which the body moves through.
  PoseTree(const kinematics::ToolPath& path, std::vector<std::uint32_t> segments, const Body& body);

  // Group i is lane i % 4 of quad i / 4. The first is the root, which has no siblings. Without
  // segments there is none.
  [[nodiscard]] std::span<const GroupQuad> quads() const { return quads_; }
  [[nodiscard]] bool is_free(std::uint32_t index) const {
    return quads_[index / kSiblings].is_free(index % kSiblings);
  }
  // Precondition: its place is not free.
  [[nodiscard]] PoseGroup group(std::uint32_t index) const {
    return quads_[index / kSiblings].group(index % kSiblings);
  }
  [[nodiscard]] bool empty() const { return quads_.empty(); }
  [[nodiscard]] std::span<const std::uint32_t> segments() const { return segments_; }

 private:
  std::vector<GroupQuad> quads_{};
  std::vector<std::uint32_t> segments_;
};

}  // namespace frustum::cutter

#include "cutter/sweep/swept_box.hpp"

namespace frustum::cutter {
namespace {

// Of a capped cylinder.
Box box_at(const AxialExtent& extent, const ToolPose& pose) {
  const Vec3 bottom = pose.tip + extent.bottom * pose.axis, top = pose.tip + extent.top * pose.axis;
  const Vec3 across =
      extent.radius * (Vec3::Ones() - pose.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return {bottom.cwiseMin(top) - across, bottom.cwiseMax(top) + across};
}

}  // namespace

Box swept_box(const AxialExtent& extent, const SegmentMotion& motion) {
  const Box ends = united(box_at(extent, motion.at(0.0)), box_at(extent, motion.at(1.0)));
  // Points of the turning body run on arcs: at most bend/8 outside their chords.
  const Vec3 beside = Vec3::Constant(motion.bend() / 8.0);
  return {ends.min - beside, ends.max + beside};
}

}  // namespace frustum::cutter

// Where and how a moving cutter touches an end of what it covers.
//
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : the normal is as exact as the moment of the contact: the end depends on that only to
//            the second
//            order, so that 1e-12 mm of the end are 1e-6 rad of the normal
#pragma once

#include <cstdint>

#include "core/pose.hpp"
#include "cutter/body/body.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/sweep/segment_motion.hpp"

namespace frustum::cutter {

// How a point of the swept surface came about.
struct SweepContact {
  double s = 0.0;  // mm along the ray
  std::uint32_t segment = 0;
  std::uint32_t section = 0;    // of the cutter's body, or kConcaveSurface
  ProfileFace face = kTopFace;  // of that section
  double t = 0.0;               // moment within the segment, 0..1
  kinematics::ToolPose pose{};  // of the cutter at that time
  // Unit, out of the cutter: that of the swept surface. On a rim, where the cutter's faces meet at
  // an angle, it is between theirs, across the motion.
  Vec3 normal = Vec3::UnitZ();
};

[[nodiscard]] SweepContact sweep_contact(const Body& body, const SegmentMotion& motion,
                                         const Ray& ray, const SweptIntervalEnd& end);

}  // namespace frustum::cutter

// Where and when a cutter that turns reaches farthest along a ray: not only how far.
#include <gtest/gtest.h>

#include <cmath>

#include "cutter/sweep/segment_sweep.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::cutter {
namespace {

using proof::Draw;

// A tapered ball of 6 mm, its ball and its flank tangent to each other.
Profile taper_ball() {
  constexpr double kRadius = 3.0, kTaper = 0.035, kTop = 40.0;  // mm, rad, mm
  const double joint = kRadius * (1.0 - std::sin(kTaper));
  const double at_joint = kRadius * std::cos(kTaper);
  return Profile({sphere_zone(kRadius, kRadius, 0.0, joint),
                  cone_zone(at_joint, at_joint + std::tan(kTaper) * (kTop - joint), joint, kTop)});
}

// The end's own motion along its normal (mm a segment) is 0 where it reaches farthest in between:
// the envelope condition. Ends at a flat height say little of their moment, and normals go by that.
TEST(SweptTops, AreWhereTheEnvelopeConditionHolds) {
  const Profile body = taper_ball();
  Draw draw(11);
  int tops = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 axis = draw.axis(0.6);
    const ToolPose from{Vec3::Zero(), axis};
    const Vec3 lean = draw.between(0.005, 0.06) * axis.cross(draw.direction()).normalized();
    const ToolPose to{draw.decades(0.1, 3.0) * draw.direction(), (axis + lean).normalized()};
    const SegmentMotion motion(from, to, body.reach());
    const Vec3 aim = draw.between(0.0, body.height()) * axis + 4.0 * draw.direction();
    const Ray ray{aim, draw.direction()};
    for (const SegmentInterval& interval : swept_intervals(body, motion, ray)) {
      for (const SweptEnd& end : {interval.lo, interval.hi}) {
        if (!(0.0 < end.t && end.t < 1.0) || end.face < 0) continue;
        const Vec3 point = ray.at(end.s);
        const Vec3 normal = body.normal_of(end.face, motion.at(end.t), point);
        constexpr double kGrazing = 0.05;
        const double height = (point - motion.at(end.t).tip).dot(motion.at(end.t).axis);
        const bool is_on_rim = height > body.height() - 1e-6;
        if (is_on_rim || std::abs(normal.dot(ray.direction)) < kGrazing) continue;
        ++tops;
        EXPECT_NEAR(normal.dot(motion.velocity(point, end.t)), 0.0, 5e-7) << "motion " << i;
      }
    }
  }
  EXPECT_GT(tops, 1000);
}

}  // namespace
}  // namespace frustum::cutter

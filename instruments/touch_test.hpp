// A touch-trigger probe touches an artefact on a table that A and C turn.
//
// Model    : the ball centre is programmed along the nominal normal n through the point p of the
//            table, p + s n, and goes where the chain with errors takes it; it touches at
//              (c(s) + R ds - q) . m = r
//            with the actual plane (q, m), the ball radius r, and ds, how far the ball is off the
//            tip. The reading s - r, less the pre-travel of the probe in that direction
//            (probe_lobes.hpp), is how far out the surface seems to be. Nothing is linear in the
//            errors
// Units    : mm, rad; normals and offsets in the frame of the table
// Shape    : a reading a touch of the plan
// Errors   : axis-overtravel: a touch out of travel; touch-missed: no surface within 10 mm of its
//            nominal place
// Accuracy : 1e-11 mm (the last step along the normal)
// Source   : Ibaraki, Iritani, Matsushita, equations (2) to (5)
#pragma once

#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "instruments/probe_lobes.hpp"
#include "instruments/touch_plan.hpp"
#include "kinematics/model/geometric_errors.hpp"

namespace frustum::instruments {

struct TouchProbe {
  double ball_radius = 3.0;
  double tool_length = 0.0;  // from the gauge point to the centre of the ball
  ProbeLobes lobes{};
};

// How probe and artefact are mounted wrongly.
struct TouchSetup {
  Vec3 ball = Vec3::Zero();   // off the programmed tip, in the frame of the tool
  Vec3 shift = Vec3::Zero();  // of the artefact as a whole, in the frame of the table
  Vec3 tilt = Vec3::Zero();   // rad, about the crossing of the axes: Rx, then Ry, then Rz
};

// Where the axes nominally touch, each reached from its place of approach along the normal.
[[nodiscard]] Result<std::vector<TestPose>> touch_poses(const kinematics::Machine& machine,
                                                        const kinematics::GeometricErrors& errors,
                                                        const TouchPlan& plan,
                                                        const TouchProbe& probe);

// `poses`: those of touch_poses(), from which the directions of approach are taken.
[[nodiscard]] Result<std::vector<double>> touch_readings(const kinematics::Machine& machine,
                                                         const kinematics::GeometricErrors& errors,
                                                         const TouchPlan& plan,
                                                         const std::vector<TestPose>& poses,
                                                         const TouchProbe& probe,
                                                         const TouchSetup& setup);

}  // namespace frustum::instruments

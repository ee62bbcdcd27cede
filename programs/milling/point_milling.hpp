// A freeform surface milled point by point with a ball-ended cutter: where it goes, pass by pass.
//
// Model    : the centre of the ball is at r(u, v) + R n(u, v), the tool leans from the normal by
//            the lead towards growing u: axis = cos(lead) n + sin(lead) r_u / |r_u|,
//            tip = centre - R axis.
//            Passes run along u at equal steps of v; between two of them a cusp of about
//            s^2 / (8 R) is left, s their distance
// Units    : mm, rad
// Shape    : any net; normals point out of the material
// Errors   : a ball that does not fit into the hollow of the surface
// Accuracy : rounding of doubles
// Source   : textbook geometry of offset surfaces
#pragma once

#include <optional>
#include <vector>

#include "core/result.hpp"
#include "core/spline_surface.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::programs {

struct BallCutter {
  double radius = 5.0;  // mm
  double lead = 0.25;   // rad
};

[[nodiscard]] kinematics::ToolPose ball_pose(const SplineSurface& surface, const BallCutter& cutter,
                                             double u, double v);

// Along u from `run_out` mm before the surface to as much past it: blocks + 1 poses.
[[nodiscard]] std::vector<kinematics::ToolPose> ball_pass(const SplineSurface& surface,
                                                          const BallCutter& cutter, double v,
                                                          double run_out, std::size_t blocks);

// v of passes between which no cusp is higher than `cusp` mm on a flat surface; both edges have
// one.
[[nodiscard]] std::vector<double> ball_passes(const SplineSurface& surface,
                                              const BallCutter& cutter, double cusp);

// Why the ball does not fit, with u, v and the largest radius that does; nothing where it does.
[[nodiscard]] std::optional<Diagnostic> does_not_fit(const SplineSurface& surface,
                                                     const BallCutter& cutter);

}  // namespace frustum::programs

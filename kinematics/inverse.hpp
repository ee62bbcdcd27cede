// Inverse kinematics: tip and tool axis in the table frame to axis positions, for every chain.
//
// Model    : the tool axis depends on the rotary axes alone: exp(w1 q1) exp(w2 q2) v = u, the second
//            Paden-Kahan subproblem, solved as a spherical triangle and polished by Gauss-Newton; the
//            linear axes then follow from a 3x3 solve
// Units    : mm, rad; frame: table
// Errors   : unreachable direction (by how much), direction that a machine without rotary axes lacks
// Accuracy : inverse then forward within 1e-9 mm and 1e-12 rad (tests/kinematics/inverse_test.cpp)
// Source   : Paden-Kahan subproblem 2 (Murray, Li, Sastry, section 3.2)
#pragma once

#include <vector>

#include "core/result.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/machine.hpp"

namespace frustum::kinematics {

struct InverseSolution {
  AxisPositions axes{};
  bool within_travel = false;
  // The tool axis is parallel to the first rotary axis, whose position is then free (kept from before).
  bool singular = false;
};

// Rotary positions alone, at most two solutions; linear axes are left at `previous`.
[[nodiscard]] Result<std::vector<InverseSolution>> orient(const Machine& machine,
                                                          const Vec3& tool_axis,
                                                          const AxisPositions& previous);

// Linear axes for a tip position at given rotary positions: nominal chain, exact.
[[nodiscard]] AxisPositions place_tip(const Machine& machine, const Vec3& tip, double tool_length,
                                      AxisPositions rotary_given);

// Both solutions for a pose, the nearest to `previous` first; each rotary position is the full turn
// nearest to `previous` within travel.
[[nodiscard]] Result<std::vector<InverseSolution>> inverse(const Machine& machine,
                                                           const ToolPose& pose, double tool_length,
                                                           const AxisPositions& previous);

// Every axis that lies outside its travel, in words: "Z = 512.3 mm, travel -100 .. 500 mm".
[[nodiscard]] std::vector<std::string> travel_violations(const Machine& machine,
                                                         const AxisPositions& q);

}  // namespace frustum::kinematics

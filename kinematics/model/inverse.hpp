// Inverse kinematics: tip and tool axis in the table frame to axis positions, for every chain.
//
// Model    : the tool axis depends on the rotary axes alone (rotary_axes.hpp: closed form, both
//            solutions); one walk along both chains at these angles then gives the linear axes by a
//            3x3 solve
// Units    : mm, rad; frame: table
// Errors   : unreachable direction (by how much), direction that a machine without rotary axes
//            lacks
// Accuracy : inverse then forward within 1e-9 mm and 1e-12 rad (tests/kinematics/inverse_test.cpp)
// Source   : Paden-Kahan subproblem 2 (Murray, Li, Sastry, section 3.2)
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/few.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/rotary_axes.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

struct InverseSolution {
  AxisPositions axes{};
  bool within_travel = false;
  // The tool axis does not depend on one of the rotary axes here (it is parallel to the first: the
  // pole); that one keeps its previous position.
  bool singular = false;
};
using InverseSolutions = Few<InverseSolution, 2>;

// Rotary positions alone, at most two solutions; linear axes are left at `previous`.
[[nodiscard]] Result<InverseSolutions> orient(const Machine& machine, const Vec3& tool_axis,
                                              const AxisPositions& previous);

// Linear axes for a tip position at given rotary positions: nominal chain, exact.
[[nodiscard]] AxisPositions place_tip(const Machine& machine, const Vec3& tip, double tool_length,
                                      AxisPositions rotary_given);

// Both solutions for a pose, those within travel first, the nearest to `previous` first; each
// rotary position is the full turn nearest to `previous` within travel.
[[nodiscard]] Result<InverseSolutions> inverse(const Machine& machine, const ToolPose& pose,
                                               double tool_length, const AxisPositions& previous);

// Every solution: both orientations, each at all full turns within travel (of an endless axis the
// one nearest to `previous`; of an axis whose travel holds none, the nearest). Order as of
// inverse().
[[nodiscard]] Result<std::vector<InverseSolution>> all_solutions(
    const Machine& machine, const ToolPose& pose, double tool_length,
    const AxisPositions& previous = {});

[[nodiscard]] bool within_travel(const Machine& machine, const AxisPositions& q);
// Every axis that is outside its travel, in words: "Z = 512.3 mm, travel -100 .. 500 mm".
[[nodiscard]] std::vector<std::string> travel_violations(const Machine& machine,
                                                         const AxisPositions& q);

}  // namespace frustum::kinematics

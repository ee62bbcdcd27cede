// How far measured surface points move when a machine error or the tool radius is not zero.
//
// Model    : at the envelope the derivative to time vanishes, so a point p with outward normal n,
//            cut at an instant when the tool tip is at tip, moves along n by
//              machine error   n . (d_tip + d_turn x (p - tip))
//              tool radius     - d support(-n . axis) / d radius
//            A face that touches p over a span of instants leaves the deepest of what they would
//            leave: with g between g_min and g_max over the span, an error e moves p by
//            odd e + even |e|, odd = (g_min + g_max) / 2, even = -(g_max - g_min) / 2.
//            p is the point that the probe touched, the instant is that of its provenance
// Units    : mm of motion per mm or rad of the parameter, along the outward normal; frame:
//            workpiece
// Shape    : all measured points (in the order of features and points) by all parameters
// Errors   : measured points whose provenance nobody knows: those of another probe, or of a file
// Accuracy : contacts are those of the trial with its errors, motions those of the nominal chain:
//            off by the size of the errors, relatively (1e-4 for 100 urad). Normals are those in
//            which the ball touches the cut surface, facets and all. Agrees with central
//            differences of whole trials: characteristics in
//            tests/trials/step_sensitivity_test.cpp and cone_sensitivity_test.cpp, single points of
//            the five-axis cone within 1e-5 of the gain in tests/trials/surface_gain_test.cpp
// Source   : first-order gains of the chain: kinematics/errors/error_gain.hpp; envelope theorem
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"
#include "trials/parameter.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

struct SurfaceGains {
  Eigen::MatrixXd odd{};
  Eigen::MatrixXd even{};
};

[[nodiscard]] Result<SurfaceGains> surface_gains(const kinematics::Machine& machine,
                                                 const programs::TestPiece& piece,
                                                 const Trial& trial,
                                                 std::span<const Parameter> parameters);

}  // namespace frustum::trials

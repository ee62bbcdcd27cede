// A compensated program run anew, beside the nominal path, by no number of a block: what a proof of
// compensation is held against.
//
// Units  : mm, rad
// Errors : EXPECT failures
#pragma once

#include <string>
#include <vector>

#include "calibration/compensate/compensation.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "programs/test_piece.hpp"

namespace frustum::calibration {

[[nodiscard]] kinematics::GeometricErrors errors_from(const kinematics::Machine& machine,
                                                      const std::vector<std::string>& texts);
[[nodiscard]] programs::TestPiece cone_piece(const kinematics::Machine& machine,
                                             programs::ProgramForm form, double chord);

// 1 % or 0.05 um.
[[nodiscard]] double allowed_residual(const PathError& before);

struct IndependentRun {
  PathError nominal{};  // of places of the nominal path at most 0.1 mm apart, to the actual one
  // Of both paths walked along together, forward only, with the turns of axes: the distance of
  // Frechet of the tips' paths and that of the axes', the worst of all runs of feed moves.
  PathError walked{};
};

[[nodiscard]] IndependentRun run_independently(const kinematics::Machine& machine,
                                               const kinematics::GeometricErrors& errors,
                                               const programs::TestPiece& nominal,
                                               const programs::TestPiece& written);

}  // namespace frustum::calibration

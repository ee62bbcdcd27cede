// A program rewritten for a machine with known errors, so that the actual tool follows the nominal
// path.
//
// Model    : the program is executed on the machine with its errors; where each block's commanded
//            axes would take a perfect machine is where the tool is wanted. The axes are moved so
//            that the actual tool gets there (kinematics/model/actual_inverse.hpp), at the block's
//            end and at as many places within it as keep the actual path within the bound. Blocks
//            keep their mode: under tool-centre-point control tip and rotary positions, otherwise
//            axis positions. Tool vectors become rotary positions, arcs become short lines, tilted
//            planes are resolved. Moves in machine coordinates and without a tool stay as they are;
//            rapids are corrected at their ends. Errors that depend on the direction of approach
//            are corrected for the directions in which the corrected axes move (stroke.hpp). What
//            masses and springs add to the path is taken off as the corrected program has it
//            (path_shift.hpp)
// Units    : mm, rad
// Errors   : what the controller refuses, before or after the correction (a corrected position
//            beyond the travel), with the NC line; dynamics together with servo lag, whose axes are
//            elsewhere than commanded
// Accuracy : proven by running the result: `after` is what was measured on it
//            (compensation_proof.hpp)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {

struct CompensationOptions {
  double bound = 2e-5;       // mm: actual against nominal tip path within a block
  double axis_bound = 1e-6;  // rad: the same for the tool axis
  // What moves the tool besides the errors, and by which time law.
  trials::TrialOptions run{};
};

// Largest distances of an actual path from the nominal one over all feed moves.
struct PathError {
  double tip = 0.0;   // mm
  double axis = 0.0;  // rad
};

// What a block of the corrected program comes from: of all blocks with a tool in the spindle, the
// number of one before the correction, and a span of its u.
struct SourceSpan {
  std::uint32_t block = 0;
  double from = 0.0;
  double to = 1.0;
  bool turn = false;  // made for an axis that turns, at one place
};

struct CompensatedProgram {
  std::vector<parser::Motion> motions{};
  std::vector<SourceSpan> sources{};  // of each block with a tool
  PathError before{};
  PathError after{};     // beside the places where an axis turns
  PathError at_turns{};  // there, while the axes go over the jump of an error
};

[[nodiscard]] Result<CompensatedProgram> compensated(const kinematics::Machine& machine,
                                                     const kinematics::GeometricErrors& errors,
                                                     const kinematics::Setup& setup,
                                                     std::span<const parser::Motion> motions,
                                                     const CompensationOptions& options = {});
// Of motions that have been commanded before; not proven yet.
[[nodiscard]] Result<CompensatedProgram> corrected(const kinematics::Machine& machine,
                                                   const kinematics::GeometricErrors& errors,
                                                   const kinematics::Setup& setup,
                                                   std::span<const parser::Motion> motions,
                                                   const kinematics::CommandedProgram& commanded,
                                                   const CompensationOptions& options = {});

}  // namespace frustum::calibration

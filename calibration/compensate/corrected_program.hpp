// A program with its positions corrected, and what of the program before each of its blocks comes
// from.
//
// Model    : what is written is commanded at once, so that the directions of approach are those of
//            the program that is written (stroke.hpp). Blocks are divided until the tool follows.
//            `shift` is what masses and springs move the tool by
// Units    : mm, rad
// Errors   : what the controller refuses after the correction, with the NC line
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calibration/compensate/compensation.hpp"
#include "calibration/compensate/path_shift.hpp"
#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"

namespace frustum::calibration {

struct CorrectedProgram {
  std::vector<parser::Motion> motions{};
  std::vector<SourceSpan> sources{};  // of each block with a tool
};

[[nodiscard]] Result<CorrectedProgram> corrected_program(
    const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
    const kinematics::Setup& setup, std::span<const parser::Motion> motions,
    const kinematics::CommandedProgram& commanded, const CompensationOptions& options,
    const PathShift& shift = {});

}  // namespace frustum::calibration

// What a compensated program leaves, found by running it.
//
// Model    : each block written comes from a span of a block of the program before. The actual tool
//            is compared with the nominal path of that span, at all samples of both: nearest
//            places, so that being early or late is no error. Where an axis turns and its error
//            jumps, the tool is off for a moment whatever is commanded; that is a figure of its
//            own: the leash (leash.hpp) on which it can follow the nominal path there
// Units    : mm, rad
// Errors   : the program written has other blocks than its sources
// Accuracy : the sampling bound
#pragma once

#include <span>

#include "calibration/compensate/compensation.hpp"
#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"

namespace frustum::calibration {

struct CompensationProof {
  PathError beside{};
  PathError
      at_turns{};  // within kTurnZone of where an axis turns, or as far as that moves the tool
};

inline constexpr double kTurnZone = 0.01;  // mm of the way

// `nominal` as commanded before the correction, `written` after it.
[[nodiscard]] Result<CompensationProof> prove(const kinematics::Machine& machine,
                                              const kinematics::GeometricErrors& errors,
                                              const kinematics::Setup& setup,
                                              const kinematics::CommandedProgram& nominal,
                                              const kinematics::CommandedProgram& written,
                                              std::span<const SourceSpan> sources,
                                              const CompensationOptions& options);

}  // namespace frustum::calibration

// A commanded program on an actual machine: the tool path, with all errors, over time.
//
// Model    : path_recorder.hpp. The program is commanded once; every travel evaluates the commanded
//            motions and the forward chain only, so that a study repeats from here on
// Units    : mm, rad, s
// Errors   : none: what is commanded has been checked
#pragma once

#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/path/path_recorder.hpp"

namespace frustum::kinematics {

struct Travel {
  ToolPath path{};          // empty when a sink took it
  double cycle_time = 0.0;  // s
};

// `setup` gives the tools as they are and where the workpiece is; the program was commanded for the
// same tool lengths and work offsets.
[[nodiscard]] Travel travel(const Machine& machine, const Setup& setup,
                            const CommandedProgram& commanded, const GeometricErrors& errors,
                            const TravelOptions& options = {});

}  // namespace frustum::kinematics

// The model of a study of a job: many machines cut and measure its part.
//
// Model    : full: the machines of the draws cut and measure the piece as it was commanded once
//            (trials/population/population.hpp); where a point of the plan cannot be followed from
//            machine to machine, run_trial() for each draw.
//            linear: every measured point of the machine without the drawn errors moves along its
//            normal by gains x weights (trials/surface_gain.hpp), and the plan is evaluated again
// Units    : as study_model.hpp
// Shape    : as study_model.hpp
// Errors   : those of the nominal trial; a nominal machine whose part is out of its limits
// Accuracy : full: that of a trial; linear: first order, see studies/engine/engine_controls.hpp
// Source   : ours
#pragma once

#include "app/study/study_model.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::unique_ptr<StudyModel>> make_piece_model(const StudyFile& study);

}  // namespace frustum::app

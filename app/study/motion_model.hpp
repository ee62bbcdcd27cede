// The model of a study of a motion test: what the instrument reads of many machines.
//
// Model    : full: the readings of the exact chain of the draw, evaluated as `frustum motion` does
//            (app/motion/drawn_test.hpp). linear: the readings of the machine without the drawn
//            errors and gains x weights, evaluated again; gains are central differences of readings
//            over 0.1 um and 0.1 mrad. [measurement] noise: both with the noise of the instrument
// Units    : as study_model.hpp
// Shape    : as study_model.hpp
// Errors   : those of the factors; a reading beyond the stroke of the bar fails its draw
// Accuracy : full: that of the chain; linear: first order
// Source   : ours
#pragma once

#include "app/study/study_model.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::unique_ptr<StudyModel>> make_motion_model(const StudyFile& study);

}  // namespace frustum::app

// The model of a study of one pose: how far many machines' tips are from where they should be.
//
// Model    : full: the exact chain of the draw, tip in the table frame less the nominal one.
//            linear: to first order. The characteristic is the length of the difference; of normal
//            laws its distribution is known exactly (studies/statistics/normal_length.hpp)
// Units    : as study_model.hpp
// Shape    : as study_model.hpp
// Errors   : those of the factors
// Accuracy : full: that of the chain; linear: first order
// Source   : ours
#pragma once

#include "app/study/study_model.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::unique_ptr<StudyModel>> make_volumetric_model(const StudyFile& study);

// Where every law is normal and nothing but sizes is drawn.
[[nodiscard]] std::optional<studies::ExactLength> exact_length(const StudyModel& model,
                                                               std::optional<double> limit);

}  // namespace frustum::app

// The page of a study: what the samples look like.
// Units: um, urad. Errors: none.
#pragma once

#include <string>

#include "app/study/sample_columns.hpp"
#include "app/study/study_file.hpp"
#include "app/study/study_model.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

[[nodiscard]] std::string study_report(const StudyFile& study, const StudyModel& model,
                                       const studies::StudyResult& result,
                                       const SampleColumns& samples);

}  // namespace frustum::app

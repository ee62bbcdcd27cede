// The page of a study: what the samples look like.
// Units: um, urad; inches where the wording says so. Errors: none.
#pragma once

#include <string>

#include "app/study/sample_columns.hpp"
#include "app/study/study_file.hpp"
#include "app/study/study_model.hpp"
#include "report/wording.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

[[nodiscard]] std::string study_report(const StudyFile& study, const StudyModel& model,
                                       const studies::StudyResult& result,
                                       const SampleColumns& samples,
                                       const report::Wording& words = report::Wording());

}  // namespace frustum::app

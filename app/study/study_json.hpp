// What a study found, as result.json holds it and as people read it on a terminal.
//
// result.json says nothing of times, machines, ranks and threads: equal studies give equal bytes.
// Units: um, urad; as named. Errors: none.
#pragma once

#include <string>

#include "app/study/study_file.hpp"
#include "report/wording.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

[[nodiscard]] std::string study_json(const studies::StudyResult& result);
[[nodiscard]] std::string study_text(const studies::StudyResult& result,
                                     const report::Wording& words = report::Wording());

}  // namespace frustum::app

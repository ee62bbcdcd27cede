// frustum design --study: which test pieces of a study to cut, and which motion tests to run.
//
// Units  : um, urad, h on the terminal and in the document
// Errors : of the study; a limit of what is not unknown
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view/console.hpp"
#include "calibration/design/design.hpp"

namespace frustum::app {

struct TestDesignWords : AnswerOptions {
  std::string study{};
  std::vector<std::string> required{};
  std::vector<std::string> limits{};  // "EB0C=1urad"
  std::optional<double> hours{};      // budget
  calibration::DesignCriterion criterion = calibration::DesignCriterion::d_optimal;
};

// The exit code.
[[nodiscard]] int show_test_design(const TestDesignWords& words);

}  // namespace frustum::app

// frustum motion probe: a cut part on the machine that cut it, beside the same part on a CMM.
//
// Units  : mm, degrees, um in the words; --noise is two standard deviations of a touch
// Errors : of job and words, of the trial, and of the touches
#pragma once

#include <optional>
#include <string>

#include "app/job/job.hpp"
#include "app/motion/motion_answer.hpp"

namespace frustum::app {

struct ProbeWords : AnswerOptions {
  std::string job{};
  JobOverrides overrides{};
  std::string at{};  // "A=0,C=0;A=-90,C=0"; empty: Z of the workpiece along the tool
  std::optional<double> tool_length{};  // none: that of the job's first tool
  std::string setup{};                  // "ball=10,-5,3"
  std::string noise{};
  std::uint64_t seed = 1;
  LobeWords lobes{};
  std::string measured{};  // a log of touches; empty: they are simulated
  std::string out{};
  report::ReportStyle style{};
};

[[nodiscard]] Result<MotionAnswer> probe_answer(const ProbeWords& words);

}  // namespace frustum::app

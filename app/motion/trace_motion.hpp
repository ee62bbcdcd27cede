// frustum motion trace: what measured readings of a bar, a laser or a touch probe say.
//
// Units  : mm and degrees in the words
// Errors : of words and files, with their lines
#pragma once

#include "app/motion/motion_answer.hpp"

namespace frustum::app {

struct TraceWords : AnswerOptions {
  std::vector<std::string> files{};
  std::string plane{};
  std::optional<double> length{};
  std::string capture{};              // "-20,200"
  std::string angle = "command";      // or feed: by time between feed-in and feed-out
  std::optional<double> overshoot{};  // degrees before and after the capture
  double stroke = 1.0;
  std::string axis{};     // of a line
  std::string machine{};  // of touches
  std::string noise{};    // of touches, two standard deviations; of R-tests one
  std::string balls{};    // of R-tests: "x,y,z;x,y,z;x,y,z"
  std::string out{};
  report::ReportStyle style{};
};

[[nodiscard]] Result<MotionAnswer> trace_answer(const TraceWords& words);

}  // namespace frustum::app

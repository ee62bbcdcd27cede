// frustum motion trace: what a measured trace of a bar or a laser says.
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
  std::string capture{};  // "-20,200"
  double stroke = 1.0;
  std::string axis{};  // of a line
  std::string out{};
};

[[nodiscard]] Result<MotionAnswer> trace_answer(const TraceWords& words);

}  // namespace frustum::app

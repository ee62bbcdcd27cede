// frustum motion rotary: a ball bar while one rotary axis turns and the linear axes follow.
//
// Units  : mm and degrees in the words
// Errors : of words, machine and test; a direction that is not said
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/rotary_test.hpp"

namespace frustum::app {

struct RotaryWords : MotionWords {
  std::string axis{};
  std::string direction{};
  std::string hold{};  // empty: that with which the tip stands still
  std::string ball{};
  double length = 150.0;
  std::string angles{};
};

[[nodiscard]] Result<instruments::RotaryTest> rotary_of_words(const RotaryWords& words,
                                                              const MotionSetup& setup);
[[nodiscard]] Result<MotionAnswer> rotary_answer(const RotaryWords& words);

}  // namespace frustum::app

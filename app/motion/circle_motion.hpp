// frustum motion circle: a ball bar on a circle of two linear axes.
//
// Units  : mm, degrees, mm/min in the words
// Errors : of words, machine and circle
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/circle_test.hpp"

namespace frustum::app {

struct CircleWords : MotionWords {
  std::string plane{};
  double length = 150.0;
  std::string centre{};
  std::string angles{};
};

// As the words say, ccw.
[[nodiscard]] Result<instruments::CircleTest> circle_of_words(const CircleWords& words,
                                                              const MotionSetup& setup);
[[nodiscard]] Result<MotionAnswer> circle_answer(const CircleWords& words);

}  // namespace frustum::app

// frustum motion cone: a ball bar on the five-axis path of the cone test.
//
// Units  : mm and degrees in the words
// Errors : of words, machine and test
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/cone_test.hpp"

namespace frustum::app {

struct ConeMotionWords : MotionWords {
  double cone_angle = 45.0;
  double inclination = 30.0;
  double radius = 40.0;
  std::string centre = "-65,0,150";
  std::string sense = "normal";
  std::string angles{};
};

[[nodiscard]] Result<instruments::ConeTest> cone_of_words(const ConeMotionWords& words,
                                                          const MotionSetup& setup);
[[nodiscard]] Result<MotionAnswer> cone_answer(const ConeMotionWords& words);

}  // namespace frustum::app

// frustum motion chase: an R-test, the tip stays at the table ball while the rotary axes go.
//
// Units  : mm and degrees in the words
// Errors : of words, machine and test
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/chase_test.hpp"

namespace frustum::app {

struct ChaseWords : MotionWords {
  std::string ball{};
};

[[nodiscard]] Result<instruments::MotionTest> chase_of_words(const ChaseWords& words,
                                                             const MotionSetup& setup);
// What masses and springs move the tip by in each pose while the rotary axes go evenly from pose to
// pose and the linear ones keep the tip at the ball; empty where nothing does.
[[nodiscard]] Result<std::vector<Vec3>> chase_deviations(const ChaseWords& words,
                                                         const MotionSetup& setup,
                                                         const instruments::MotionTest& test,
                                                         const std::optional<double>& feed);
[[nodiscard]] Result<MotionAnswer> chase_answer(const ChaseWords& words);

}  // namespace frustum::app

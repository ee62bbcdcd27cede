// frustum motion line, diagonal: a laser along an axis, or along the diagonals of a box.
//
// Units  : mm in the words
// Errors : of words, machine and lines
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/line_test.hpp"
#include "instruments/positioning.hpp"

namespace frustum::app {

struct LineWords : MotionWords {
  std::string axis{};
  std::string targets{};
  int runs = 5;
};
[[nodiscard]] Result<MotionAnswer> line_answer(const LineWords& words);

struct DiagonalWords : MotionWords {
  std::string box{};
  int points = 11;
};
[[nodiscard]] Result<std::map<std::string, instruments::LineTest>> diagonals_of_words(
    const DiagonalWords& words, const MotionSetup& setup);
[[nodiscard]] Result<MotionAnswer> diagonal_answer(const DiagonalWords& words);

// Puts `evaluation` into the document and its table into the text; deviations in mm.
[[nodiscard]] std::optional<Diagnostics> add_positioning(MotionAnswer& answer,
                                                         const std::vector<double>& targets,
                                                         const instruments::Deviations& up,
                                                         const instruments::Deviations& down);

}  // namespace frustum::app

// frustum motion line, diagonal: a laser along an axis, or along the diagonals of a box.
//
// Units  : mm in the words
// Errors : of words, machine and lines
#pragma once

#include "app/motion/motion_answer.hpp"
#include "instruments/line_straightness.hpp"
#include "instruments/line_test.hpp"
#include "instruments/positioning.hpp"

namespace frustum::app {

struct LineWords : MotionWords {
  std::string axis{};
  std::string targets{};
  int runs = 5;
};
// Runs up and down by turns over the targets of one axis.
struct LineRuns {
  kinematics::AxisLetter axis = kinematics::AxisLetter::X;
  std::vector<double> targets{};  // mm
  instruments::LineTest up{}, down{};
};
[[nodiscard]] Result<LineRuns> line_of_words(const LineWords& words, const MotionSetup& setup);

// What the runs show, by target: along the axis for each run, and the mean displacement.
struct LineDeviations {
  instruments::Deviations up{}, down{};
  std::vector<Vec3> means{};
};
// `shown`: displacements of each run in its order, up first.
[[nodiscard]] LineDeviations by_target(const LineRuns& line,
                                       const std::vector<std::vector<Vec3>>& shown);
// Of the mean displacements, across the axis; nothing of fewer than three targets.
[[nodiscard]] std::map<kinematics::AxisLetter, instruments::Straightness> straightness_across(
    const LineRuns& line, const std::vector<Vec3>& means);

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

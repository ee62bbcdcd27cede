// The set-up sheet of a bar whose NC program is written: what goes where, what is captured, and
// what of travels and stroke that takes.
//
// Units  : mm, degrees, um, as named
// Errors : set-up-collides: the bar, or what holds its balls, meets the machine
#pragma once

#include "app/motion/motion_answer.hpp"
#include "programs/motion/motion_program.hpp"

namespace frustum::app {

struct SetupSheet {
  const kinematics::Machine& machine;
  const instruments::MotionTest& test;
  const programs::TestPiece& program;
  std::string parameter{};  // "phi", "C"
  double stroke = 1.0;      // of the bar, to either side
  std::vector<double> readings{};
};

// A table and a drawing on the page, `setup_sheet` in the document and setup.csv among the files.
[[nodiscard]] std::optional<Diagnostics> add_setup_sheet(MotionAnswer& answer,
                                                         const SetupSheet& sheet);

}  // namespace frustum::app

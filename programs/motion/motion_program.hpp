// The NC programs of motion tests: what a control runs while a ball bar, an R-test or a laser
// reads.
//
// Model    : form tcp: the tip as programmed under tool centre point control, in the frame of the
//            table; axes: positions of all axes, cut so fine that the tip stays within 10 nm. G54
//            is at the table ball (a circle: at its centre, in axis positions; a line: where X, Y
//            and Z are zero), tool 1 is the spindle ball with its length. A bar is approached 1.5
//            mm too long, where the program stops for it to be mounted; it is fed in radially,
//            which marks the start, the parameter grows with its overshoot, the bar is fed out;
//            after a dwell the same back. Circles are arcs; Klartext has them in XY alone and
//            chords elsewhere. R-tests and lasers dwell at every pose
// Units    : mm, rad; feed mm/min, deg/min where only rotary axes move
// Errors   : axis-overtravel: a place of approach that the machine does not reach; what the dialect
//            has no words for
// Accuracy : 1e-6 mm of the words; chords 1e-5 mm (tests/app/motion_program_test.cpp reads them
//            back)
// Source   : ISO 230-4, ISO 230-2, ISO 10791-6 by their names; approach and dwell as bar makers
//            have them
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/line_test.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

enum class MotionForm { tcp, axes };

struct MotionProgramOptions {
  parser::Dialect dialect = parser::Dialect::fanuc;
  MotionForm form = MotionForm::tcp;
  double feed = 1000.0;
  double dwell = 2.0;  // s
};

// Offset and tool that such programs need; `origin`: of G54 in the table frame.
[[nodiscard]] TestPiece motion_frame(const Vec3& origin, double tool_length);
// Of a circle: at its centre, in axis positions with the rotary axes at zero.
[[nodiscard]] Vec3 circle_origin(const kinematics::Machine& machine,
                                 const instruments::CircleTest& circle);
// Of lines: where the axes are zero.
[[nodiscard]] Vec3 line_origin(const kinematics::Machine& machine, double tool_length);

// Offsets, tool, title and text; no blank and no plan.
[[nodiscard]] Result<TestPiece> circle_program(const kinematics::Machine& machine,
                                               const instruments::CircleTest& circle,
                                               const MotionProgramOptions& options);
// `name`: of the file and of the program, "rotary"; the parameter grows, then falls.
[[nodiscard]] Result<TestPiece> bar_program(const kinematics::Machine& machine,
                                            const std::string& name, const std::string& title,
                                            const instruments::MotionTest& test,
                                            const MotionProgramOptions& options);
[[nodiscard]] Result<TestPiece> chase_program(const kinematics::Machine& machine,
                                              const instruments::MotionTest& test,
                                              const MotionProgramOptions& options);
// Runs in their order, each from its start on.
[[nodiscard]] Result<TestPiece> line_program(const kinematics::Machine& machine,
                                             const std::string& name, const std::string& title,
                                             std::span<const instruments::LineTest> runs,
                                             double tool_length,
                                             const MotionProgramOptions& options);

// Where a pass begins and ends: the overshoot as far as the travels have it.
struct BarPass {
  double from = 0.0;
  double to = 0.0;
};
[[nodiscard]] BarPass pass_of(const kinematics::Machine& machine,
                              const instruments::MotionTest& test);

}  // namespace frustum::programs

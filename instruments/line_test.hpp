// A laser along one axis, or along the diagonals of a box.
//
// Model    : targets on a straight line of axis positions; the laser reads d . e, the displacement
//            d of the tip along the nominal direction e. Runs up (from the first target to the
//            last) and down alternate, each with an overrun before its first target; along a
//            diagonal one run
// Units    : mm, rad; frame: table
// Shape    : targets of an axis increase; a box has two or three axes, its diagonals begin at its
//            low first axis: 2 of a face, 4 of a body
// Errors   : an axis that the machine lacks, targets that do not increase, fewer than two, a box
//            of one axis or without width, targets out of reach
// Accuracy : nominal positions to rounding
// Source   : ISO 230-2 (lines), ISO 230-6 (diagonals), by their names
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "instruments/setup_errors.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

struct LineTest {
  std::vector<TestPose> poses{};      // in the order of the run; parameter: mm (rad) along the line
  kinematics::AxisPositions start{};  // where the axes come from
  Vec3 direction = Vec3::UnitX();     // e
};

enum class RunDirection { up, down };

// Positions of one axis, mm or rad as the axis has; the other axes are held.
struct AxisLine {
  kinematics::AxisLetter axis = kinematics::AxisLetter::X;
  std::vector<double> targets{};
  kinematics::AxisPositions held{};
  double tool_length = 0.0;
  double overrun = 5.0;  // mm
};
// The targets in increasing order, whichever the direction of the run.
[[nodiscard]] Result<LineTest> axis_line(const kinematics::Machine& machine, const AxisLine& line,
                                         RunDirection direction);

struct Diagonals {
  std::map<kinematics::AxisLetter, kinematics::AxisRange> box{};
  int points = 11;
  kinematics::AxisPositions held{};
  double tool_length = 0.0;
};
// By their signs, "+++", "++-", "+-+", "-++" (a face: "++", "+-"): the axes in the order X, Y, Z.
[[nodiscard]] Result<std::map<std::string, LineTest>> diagonal_lines(
    const kinematics::Machine& machine, const Diagonals& diagonals);

// Displacements along the line, as many as poses.
[[nodiscard]] std::vector<double> line_readings(const kinematics::ForwardChain& actual,
                                                const LineTest& line, const SetupErrors& setup);
// As the laser shows them: the first target taken off.
[[nodiscard]] std::vector<double> from_first(std::vector<double> readings);

}  // namespace frustum::instruments

// A motion test of many machines: the axes are commanded once, and each machine has readings and
// values of its own. Studies draw such machines.
//
// Model    : readings of the exact chain, all runs one after the other; values as
//            `frustum motion` evaluates them:
//              circle        G_ccw, G_cw, G_bi (least squares), F (the largest), D, square (urad),
//                            scale, servo, backlash_1, backlash_2
//              rotary, cone  mean, amplitude_1, amplitude_2 of the harmonics, form
//              chase         rms, largest, and the ranges x, y, z
//              line          A, R, E, M, B, straightness across the axis (minimum zone)
//              diagonal      the range along each ("+++"), largest, spread of the ends
// Units    : readings mm; values um and urad
// Shape    : as many readings for every machine; displacements count three, x y z
// Errors   : those of words, machine and test; a program to be run, a touch calibration, which has
//            maps and no values. Of one machine: a reading beyond the stroke of the bar
// Accuracy : that of instruments/readings.hpp
// Source   : ISO 230-2, 230-4, 230-6, ISO 10791-6 by their names
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/motion/test_file.hpp"
#include "core/result.hpp"

namespace frustum::app {

struct TestValue {
  std::string name{};  // "circle.G_bi"
  bool angular = false;
  bool both_sides = false;  // of either sign
  bool of_form = false;     // a range or length of readings that move in proportion to the errors
};

struct DrawnTest {
  std::vector<TestValue> values{};
  // Before noise.
  std::function<std::vector<double>(const kinematics::GeometricErrors&)> readings{};
  // Readings that values of form do not see, as lists of all readings.
  std::vector<std::vector<double>> unseen_by_forms{};
  // Why a bar cannot show them; empty: any instrument can.
  std::function<std::optional<Diagnostic>(const std::vector<double>& shown)> beyond{};
  // In the order of `values`, of what the instrument has shown.
  std::function<Result<std::vector<double>>(const std::vector<double>& shown)> evaluate{};
};

// `setup`: motion_setup() of the words; it must outlive the test. Its errors are not looked at.
[[nodiscard]] Result<DrawnTest> drawn_test(const TestWords& words, const MotionSetup& setup);

}  // namespace frustum::app

// Where the readings of a test say that its balls and its bar are.
//
// Model    : reading = -u . db - dL: least squares over all readings of a machine without errors;
//            of set-ups that explain them as well the smallest. What errors of the machine look
//            like a set-up is in it
// Units    : um in the document
// Errors   : none
// Accuracy : first order
// Source   : instruments/readings.hpp
#pragma once

#include <span>
#include <vector>

#include "app/motion/motion_answer.hpp"

namespace frustum::app {

struct BarReadings {
  const instruments::MotionTest& test;
  std::span<const double> readings{};  // mm
};
// `setup_found_um` with table_ball and length in the document, a line in the text, facts on the
// page.
void add_setup_found(MotionAnswer& answer, std::span<const BarReadings> runs);
// Of an R-test, whose displacements are those of a ball that is off.
void add_setup_found(MotionAnswer& answer, std::span<const Vec3> displacements);
// Of a measured circle: its centre in the plane, and how much its mean radius is above nominal, mm.
void add_setup_found(MotionAnswer& answer, double first, double second, double radius);

}  // namespace frustum::app

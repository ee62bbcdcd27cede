// A line measured on a surface, brought to one height along that surface, and its straight line.
//
// Model    : every point slides within the plane across the line, on the nominal surface, until its
//            height is the one wanted: the line of a leaning surface moves sideways with the height
//            at which it is read. Then across = offset + slope along, least squares
// Units    : mm; slope in rad (mm per mm)
// Shape    : n >= 2 points at different places along the line
// Errors   : points at one place along the line
// Accuracy : first order in the tilt of the surface against its nominal, as the normal is nominal
// Source   : ours
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/measurement.hpp"
#include "metrology/plan/line_axes.hpp"

namespace frustum::metrology {

struct PlaceOnLine {
  double along = 0.0;
  double across = 0.0;
};
// `normal` of the surface must have a component along `across`.
[[nodiscard]] std::vector<PlaceOnLine> shifted(std::span<const MeasuredPoint> points,
                                               const LineAxes& axes, const Vec3& normal,
                                               double height);

struct StraightLine {
  double offset = 0.0;  // across, at the origin of `along`
  double slope = 0.0;
};
[[nodiscard]] Result<StraightLine> straight_line(std::span<const PlaceOnLine> places);

}  // namespace frustum::metrology

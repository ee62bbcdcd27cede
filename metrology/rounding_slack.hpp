// How far a value may be beyond its limit by rounding alone.
//
// Model    : 16 units in the last place of the largest of value, nominal and tolerance: a diameter
//            of 10 mm that is planned at its limit of 10.001 mm is 1e-15 mm beyond it once 10 is
//            taken away, and the fit that found it rounds as much. No measurement sees it: 4e-14 mm
//            of 10 mm
// Units    : any, the same for all
// Shape    : one characteristic
// Errors   : none
// Accuracy : exact
// Source   : ours
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::metrology {

[[nodiscard]] inline double rounding_slack(double value, double nominal, double tolerance) {
  return 16.0 * std::numeric_limits<double>::epsilon() *
         std::max({std::abs(value), std::abs(nominal), std::abs(tolerance)});
}

}  // namespace frustum::metrology

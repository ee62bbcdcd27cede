// What the statement of a CMM says of one measured point.
//
// Model    : every point has the standard deviation p = e0/2 along its normal; the machine's linear
//            field has three scale and three squareness terms of standard deviation s = 1/(2 k).
//            A probe that is stated beside a linear field adds its mean squares to p^2;
//            temperatures add twice the variance of the growth of all lengths to s^2, and what is
//            not compensated counts whole
// Units    : mm
// Shape    : closed formulas
// Errors   : none
// Accuracy : first order
// Source   : JCGM 100:2008, section 5.1.2
#pragma once

#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

struct PointUncertainty {
  double probing = 0.0;  // mm, p above
  double scale = 0.0;    // relative, s above

  // Of a machine that has no errors, or of which nothing is known.
  [[nodiscard]] bool is_zero() const { return probing == 0.0 && scale == 0.0; }
};
[[nodiscard]] PointUncertainty point_uncertainty(const CmmModel& cmm);

}  // namespace frustum::metrology

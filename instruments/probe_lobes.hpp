// How much farther a touch-trigger probe travels before it trips, by the direction of the touch.
//
// Model    : pre-travel = constant + lobe sin^3(t) cos(3 (phi - phase)); t: angle between the
//            outward normal and the stylus, phi: angle of the normal about the stylus from X of the
//            tool. The probe keeps its attitude in the spindle, so that lobes stay with the machine
//            while the table turns. A surface so seems to be further in
// Units    : mm, rad; directions in the frame of the tool
// Errors   : none
// Accuracy : exact
// Source   : sin^3 cos 3 phi is the three-lobed surface harmonic, as in
//            metrology/probing/probe_form.hpp
#pragma once

#include "core/pose.hpp"

namespace frustum::instruments {

struct ProbeLobes {
  double constant = 0.0;
  double amplitude = 0.0;
  double phase = 0.0;  // of a lobe, about the stylus

  [[nodiscard]] bool any() const { return constant != 0.0 || amplitude != 0.0; }
};

// mm of a touch whose surface faces `outward` (unit).
[[nodiscard]] double pre_travel(const ProbeLobes& lobes, const Vec3& outward);

}  // namespace frustum::instruments

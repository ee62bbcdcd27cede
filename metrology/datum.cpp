#include "metrology/datum.hpp"

#include <cmath>

namespace frustum::metrology {

Result<Pose> datum_frame(const DatumElements& elements) {
  const Vec3 z = elements.primary.axis;
  const Vec3 along = elements.secondary.axis;
  const double steepness = along.dot(z);
  // At 1e-3 rad an axis error of 1 um moves the piercing point by 1 mm.
  if (std::abs(steepness) < 1e-3) {
    return error("the secondary datum axis does not pierce the primary datum plane",
                 "choose a cylinder that stands on the plane");
  }
  const Vec3 trace = elements.tertiary ? Vec3(z.cross(elements.tertiary->axis.vec()))
                                       : Vec3(elements.clocking - elements.clocking.dot(z) * z);
  if (!(trace.norm() > 1e-3)) {  // as above, for the direction of the trace
    return error("the tertiary datum does not give a direction in the primary datum plane",
                 "choose a groove face that stands across the plane");
  }
  Pose frame;
  const Vec3 y = trace.normalized();
  frame.rotation << y.cross(z), y, z;
  const double distance = (elements.primary.point - elements.secondary.point).dot(z) / steepness;
  frame.translation = elements.secondary.point + distance * along;
  return frame;
}

}  // namespace frustum::metrology

#include "instruments/probe_lobes.hpp"

#include <cmath>

namespace frustum::instruments {

double pre_travel(const ProbeLobes& lobes, const Vec3& outward) {
  const double x = outward.x(), y = outward.y();
  // sin^3(t) cos(3 phi) and sin^3(t) sin(3 phi)
  const double cosine = x * (x * x - 3.0 * y * y), sine = y * (3.0 * x * x - y * y);
  return lobes.constant + lobes.amplitude * (cosine * std::cos(3.0 * lobes.phase) +
                                             sine * std::sin(3.0 * lobes.phase));
}

}  // namespace frustum::instruments

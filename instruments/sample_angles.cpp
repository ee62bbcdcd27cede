#include "instruments/sample_angles.hpp"

namespace frustum::instruments {

std::vector<double> midpoints(double from, double to, int count) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) angles.push_back(from + (to - from) * (i + 0.5) / count);
  return angles;
}

}  // namespace frustum::instruments

#include "dynamics/dynamic_model.hpp"

#include <algorithm>

namespace frustum::dynamics {

bool DynamicModel::is_controlled() const {
  return std::ranges::any_of(axes, [](const AxisModel& a) { return a.control.has_value(); });
}

std::string DynamicModel::body_name(std::size_t body) const {
  return body == 0 ? "bed" : std::string(1, to_char(axes[body - 1].joint.letter));
}

std::optional<std::size_t> DynamicModel::axis(kinematics::AxisLetter letter) const {
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (axes[k].joint.letter == letter) return k;
  }
  return std::nullopt;
}

}  // namespace frustum::dynamics

#include "kinematics/model/work_offset.hpp"

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::kinematics {

std::optional<Vec3> placed_origin(const Machine& machine, const parser::WorkOffsetSetting& setting,
                                  const std::optional<Vec3>& before) {
  AxisPositions at_origin;
  if (before) at_origin = place_tip(machine, *before, 0.0, AxisPositions{});
  for (std::size_t i = 0; i < setting.origin.size(); ++i) {
    const auto& value = setting.origin.at(i);
    if (!value && !before) return std::nullopt;
    if (value) at_origin[parser::kAxisLetters.at(i)] = *value;
  }
  return nominal_pose(machine, at_origin, 0.0).translation;
}

}  // namespace frustum::kinematics

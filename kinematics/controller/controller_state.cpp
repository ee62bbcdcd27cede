#include "kinematics/controller/controller_state.hpp"

#include <variant>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/work_offset.hpp"

namespace frustum::kinematics {

ControllerState::ControllerState(const Machine& machine, const Setup& setup)
    : machine_(machine), setup_(setup), origins_(setup.work_offsets) {
  place_words();
}

void ControllerState::follow(const parser::Command& command) {
  modes_.follow(command);
  if (const auto* setting = std::get_if<parser::WorkOffsetSetting>(&command)) {
    if (const auto origin = placed(*setting)) origins_[setting->number] = *origin;
    place_words();
  } else if (const auto* change = std::get_if<parser::CompensationChange>(&command)) {
    tool_length_ = length_of(*change).value_or(0.0);
    place_words();
  } else if (std::holds_alternative<parser::WorkOffsetChange>(command) ||
             std::holds_alternative<parser::TiltedPlaneChange>(command)) {
    place_words();
  }
}

const Vec3* ControllerState::origin_of(int number) const {
  const auto found = origins_.find(number);
  return found == origins_.end() ? nullptr : &found->second;
}

std::optional<Vec3> ControllerState::placed(const parser::WorkOffsetSetting& setting) const {
  const Vec3* before = origin_of(setting.number);
  return placed_origin(machine_, setting,
                       before == nullptr ? std::nullopt : std::optional(*before));
}

std::optional<double> ControllerState::length_of(const parser::CompensationChange& change) const {
  if (change.mode == parser::LengthCompensation::off) return 0.0;
  if (change.length) return change.length;
  const auto tool = setup_.tools.find(change.offset_number);
  if (tool == setup_.tools.end()) return std::nullopt;
  return change.negative ? -tool->second.length : tool->second.length;
}

void ControllerState::place_words() {
  const Vec3* origin = origin_of(modes_.work_offset);
  if (origin == nullptr) {
    frame_.reset();
    return;
  }
  frame_ = std::make_shared<const TipFrame>(
      TipFrame{Pose::translated(*origin) * modes_.plane.value_or(Pose{}), tool_length_});
  axis_shift_ = linear_positions(place_tip(machine_, *origin, tool_length_, AxisPositions{}));
}

Vec3 ControllerState::tip_at(const AxisPositions& q) const {
  return nominal_pose(machine_, q, tool_length_).translation;
}

Vec3 ControllerState::tip_in_words(const AxisPositions& q) const {
  return table_from_words().inverse().point(tip_at(q));
}

}  // namespace frustum::kinematics

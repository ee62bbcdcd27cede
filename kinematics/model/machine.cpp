#include "kinematics/model/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustum::kinematics {

parser::ControlSettings ControllerWords::settings() const {
  parser::ControlSettings settings;
  settings.words = words;
  settings.decimal_point = decimal_point.value_or(settings.decimal_point);
  settings.unit = units;
  settings.max_blocks = max_blocks;
  return settings;
}

std::vector<Joint> Machine::joints() const {
  std::vector<Joint> all = tool_chain_;
  all.insert(all.end(), work_chain_.begin(), work_chain_.end());
  return all;
}

const Joint* Machine::joint(AxisLetter letter) const {
  for (const auto* chain : {&tool_chain_, &work_chain_}) {
    for (const Joint& joint : *chain) {
      if (joint.letter == letter) return &joint;
    }
  }
  return nullptr;
}

AxisPositions Machine::home() const {
  AxisPositions home;
  for (const Joint& joint : joints()) home[joint.letter] = joint.home;
  return home;
}

std::optional<std::string> Machine::refused(const ErrorName& error,
                                            std::span<const AxisLetter> datum) const {
  if (!error.location || !is_rotation(error.direction) || is_rotary(error.axis))
    return std::nullopt;
  const std::string axis(1, to_char(error.axis));
  const Joint& joint = *this->joint(error.axis);
  const Vec3 about = Vec3::Unit(static_cast<Eigen::Index>(error.direction) - 3);
  // A tilt of a straight line about itself is nothing.
  if (angle_between(about, joint.direction) < 1e-12 ||
      angle_between(about, -joint.direction) < 1e-12) {
    return fmt::format("a linear axis cannot be out of square about its own direction {}", axis);
  }
  if (!datum.empty() && datum[0] == error.axis) {
    return fmt::format(
        "{} is the primary reference axis; its orientation errors are zero by choice", axis);
  }
  if (datum.size() > 1 && datum[1] == error.axis) {
    const Vec3 square = this->joint(datum[0])->direction.cross(joint.direction).normalized();
    if (std::abs(about.dot(square)) < 0.5) {
      return fmt::format(
          "{} is the secondary reference axis; of its orientation errors only the squareness to {} "
          "remains",
          axis, to_char(datum[0]));
    }
  }
  return std::nullopt;
}

std::vector<ErrorName> Machine::error_names() const {
  std::vector<ErrorName> names;
  for (const Joint& joint : joints()) {
    for (const bool location : {false, true}) {
      for (int d = 0; d < 6; ++d) {
        const ErrorName name{static_cast<ErrorDirection>(d), joint.letter, location};
        if (!refused(name)) names.push_back(name);
      }
    }
  }
  return names;
}

}  // namespace frustum::kinematics

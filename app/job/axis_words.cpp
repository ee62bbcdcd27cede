#include "app/job/axis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "app/job/number_list.hpp"

namespace frustum::app {

using kinematics::Joint;

Result<AxisWords> read_axis_words(const kinematics::Machine& machine, const std::string& text) {
  const std::vector<Joint> joints = machine.joints();
  AxisWords words;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto equals = part.find('=');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const Joint& j) {
      return name == std::string(1, to_char(j.letter));
    });
    if (equals == std::string::npos || joint == joints.end()) {
      std::vector<std::string> known;
      for (const Joint& j : joints) known.emplace_back(1, to_char(j.letter));
      return error("unknown-axis"_id,
                   fmt::format("'{}' is not an axis of machine {} ({})", part, machine.name(),
                               machine.structure()),
                   fmt::format("write {}", fmt::join(known, "=..,")) + "=..");
    }
    if (words.contains(joint->letter))
      return error("given-twice"_id, fmt::format("axis {} is given twice", name));
    const auto value = numbers_of(part.substr(equals + 1), 1, "axis " + name);
    if (!value) return value.error();
    words[joint->letter] = value->front() * (joint->rotary() ? kRadPerDeg : 1.0);
  }
  return words;
}

}  // namespace frustum::app

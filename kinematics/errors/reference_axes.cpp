#include "kinematics/errors/reference_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustum::kinematics {
namespace {

Vec3 orientation_of(const AxisErrors& errors) {
  return {errors.location[3], errors.location[4], errors.location[5]};
}

Diagnostic refusal(const std::string& reason) {
  return error("reference-axes"_id,
               "the errors cannot be stated for other reference axes: " + reason,
               "leave out `datum` and write them for the machine's own reference axes");
}

// Before the first rotary axis of its chain an axis keeps its direction in the bed.
bool is_fixed_in_bed(const Machine& machine, AxisLetter letter) {
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    for (const Joint& joint : *chain) {
      if (joint.rotary()) break;
      if (joint.letter == letter) return true;
    }
  }
  return false;
}

std::optional<std::string> obstacle(const Machine& machine, const GeometricErrors& errors) {
  const std::span<const AxisLetter> datum = machine.datum();
  if (datum.size() != 2) return "machine " + machine.name() + " names no two reference axes";
  for (const AxisLetter letter : datum) {
    if (!is_fixed_in_bed(machine, letter))
      return fmt::format("{} is carried by a rotary axis", to_char(letter));
  }
  const Vec3 primary = machine.joint(datum[0])->direction;
  constexpr double kSquare = 1e-9;
  if (std::abs(primary.dot(machine.joint(datum[1])->direction)) > kSquare)
    return fmt::format("{} and {} are not nominally square", to_char(datum[0]), to_char(datum[1]));
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    for (std::size_t i = 0; i < chain->size(); ++i) {
      const Joint& joint = (*chain)[i];
      if (!errors[joint.letter].carried_tilt.isZero(0.0))
        return fmt::format("a tilt of {} also turns what it carries", to_char(joint.letter));
      if (!joint.rotary() && joint.functional_point.at_tip && i + 1 < chain->size())
        return fmt::format("{} turns about the tip and other axes follow it",
                           to_char(joint.letter));
    }
  }
  return std::nullopt;
}

// The turn of the bed's frame that leaves the primary axis no orientation error and the secondary
// one none about the primary.
Vec3 turn_of_frame(const Machine& machine, const GeometricErrors& errors) {
  const AxisLetter first = machine.datum()[0], second = machine.datum()[1];
  const Vec3 e = machine.joint(first)->direction;
  const Vec3 tilt = orientation_of(errors[first]);
  const Vec3 across = tilt - tilt.dot(e) * e;
  return -across - orientation_of(errors[second]).dot(e) * e;
}

}  // namespace

Result<GeometricErrors> restated(const Machine& machine, const GeometricErrors& errors) {
  if (const auto reason = obstacle(machine, errors)) return refusal(*reason);
  const Vec3 turn = turn_of_frame(machine, errors);
  GeometricErrors result = errors;
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    for (const Joint& joint : *chain) {
      AxisErrors& axis = result[joint.letter];
      Vec3 orientation = orientation_of(axis) + turn;
      // The line of a linear axis is laid through its functional point; a turn of the whole is not.
      Vec3 place = turn.cross(joint.offset);
      if (!joint.rotary()) {
        orientation -= orientation.dot(joint.direction) * joint.direction;
        if (!joint.functional_point.at_tip) {
          const Vec3& p = joint.functional_point.point;
          place -= (orientation - orientation_of(axis)).cross(p);
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        axis.location[k] += place[static_cast<Eigen::Index>(k)];
        axis.location[k + 3] = orientation[static_cast<Eigen::Index>(k)];
      }
      if (joint.rotary()) break;  // it turns all that follows
    }
  }
  return result;
}

}  // namespace frustum::kinematics

#include "kinematics/model/inverse.hpp"
#include "core/constants.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustum::kinematics {
namespace {

struct Placed {
  AxisPositions axes{};
  bool spans = true;  // X, Y and Z reach every tip; false: axes are the nearest
};

// Linear axes carried by rotary ones may turn into one plane. A millionth: their positions are then
// a thousand metres off.
constexpr double kFlat = 1e-6;

// A point carried by the last joint, seen from the bed with X, Y and Z at zero; `linear` collects
// the directions of those that the chain holds. Walked inwards, so that only vectors are turned.
Vec3 in_bed(const std::vector<Joint>& chain, Vec3 point, const AxisPositions& q, Mat3& linear) {
  std::array<Eigen::Index, 3> carried{};
  std::size_t count = 0;
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    if (joint->rotary()) {
      const double angle = joint->side * q[joint->letter];
      const double s = std::sin(angle), c = std::cos(angle);
      const Vec3& w = joint->direction;
      const auto turned = [&](const Vec3& v) -> Vec3 {
        return c * v + s * w.cross(v) + ((1.0 - c) * w.dot(v)) * w;
      };
      point = turned(point);
      for (std::size_t i = 0; i < count; ++i) {
        linear.col(carried[i]) = turned(linear.col(carried[i]));
      }
    } else {
      // Moving the work by -q shows the same displacement of the tip as moving the tool by +q.
      carried[count] = static_cast<Eigen::Index>(joint->letter);
      linear.col(carried[count++]) = joint->direction;
    }
    point += joint->offset;
  }
  return point;
}

// The rotary positions are given; the tip moves, relative to the table, by `linear` times (X, Y,
// Z).
Placed placed(const Machine& machine, const Vec3& tip, double tool_length, AxisPositions q) {
  Mat3 linear;
  const Vec3 in_spindle = machine.spindle_offset() - Vec3(0.0, 0.0, tool_length);
  const Vec3 missing = in_bed(machine.work_chain(), machine.table_offset() + tip, q, linear) -
                       in_bed(machine.tool_chain(), in_spindle, q, linear);
  const Vec3 x = linear.col(0), y = linear.col(1), z = linear.col(2);
  const Vec3 yz = y.cross(z), zx = z.cross(x), xy = x.cross(y);
  const double volume = x.dot(yz);
  const bool spans = std::abs(volume) > kFlat;
  Vec3 xyz;
  if (spans) {
    const auto solve = [&](const Vec3& v) -> Vec3 {
      return Vec3(yz.dot(v), zx.dot(v), xy.dot(v)) / volume;
    };
    xyz = solve(missing);
    // What rounding left, which skew axes magnify.
    xyz += solve(missing - linear * xyz);
  } else {
    Eigen::CompleteOrthogonalDecomposition<Mat3> nearest;
    nearest.setThreshold(kFlat);
    xyz = nearest.compute(linear).solve(missing);
  }
  q[AxisLetter::X] = xyz.x();
  q[AxisLetter::Y] = xyz.y();
  q[AxisLetter::Z] = xyz.z();
  return {q, spans};
}

bool is_singular(const OrientationSolution& s) { return s.free[0] || s.free[1]; }

// The solution's angles at the turns nearest to `previous`; a free axis keeps its position.
RotaryAngles near(const RotaryAxes& rotary, const OrientationSolution& s,
                  const RotaryAngles& previous) {
  RotaryAngles q{};
  for (std::size_t i = 0; i < rotary.count(); ++i) {
    q[i] = s.free[i] ? previous[i] : best_turn(rotary.joint(i), s.angle[i], previous[i]);
  }
  return q;
}

InverseSolution with_linear_axes(const Machine& machine, const RotaryAxes& rotary,
                                 const ToolPose& pose, double tool_length,
                                 const OrientationSolution& s, const RotaryAngles& previous) {
  const Placed at =
      placed(machine, pose.tip, tool_length, rotary.with({}, near(rotary, s, previous)));
  return {at.axes, at.spans && within_travel(machine, at.axes), is_singular(s)};
}

double rotary_distance(const AxisPositions& a, const AxisPositions& b) {
  return std::abs(a[AxisLetter::A] - b[AxisLetter::A]) +
         std::abs(a[AxisLetter::B] - b[AxisLetter::B]) +
         std::abs(a[AxisLetter::C] - b[AxisLetter::C]);
}

// Within travel before outside, then near before far.
bool comes_first(const InverseSolution& a, const InverseSolution& b,
                 const AxisPositions& previous) {
  if (a.within_travel != b.within_travel) return a.within_travel;
  // 1e-9: a tie within rounding keeps the order of the closed form.
  return rotary_distance(a.axes, previous) < rotary_distance(b.axes, previous) - 1e-9;
}

// Every full turn within travel; the nearest when there is none, or no limit.
std::vector<double> turns_of(const Joint& joint, double angle, double previous) {
  const double nearest = best_turn(joint, angle, previous);
  if (joint.endless || !within_travel(joint, nearest)) return {nearest};
  std::vector<double> turns;
  double q = nearest;
  while (within_travel(joint, q - kTurn)) q -= kTurn;
  for (; within_travel(joint, q); q += kTurn) turns.push_back(q);
  return turns;
}

}  // namespace

Result<InverseSolutions> orient(const Machine& machine, const Vec3& tool_axis,
                                const AxisPositions& previous) {
  const RotaryAxes rotary(machine);
  const auto found = rotary.solve(tool_axis.normalized());
  if (!found) return found.error();
  InverseSolutions solutions;
  for (const OrientationSolution& s : *found) {
    const RotaryAngles q = near(rotary, s, rotary.angles(previous));
    solutions.push_back({.axes = rotary.with(previous, q), .singular = is_singular(s)});
  }
  return solutions;
}

AxisPositions place_tip(const Machine& machine, const Vec3& tip, double tool_length,
                        AxisPositions rotary_given) {
  return placed(machine, tip, tool_length, rotary_given).axes;
}

Result<InverseSolutions> inverse(const Machine& machine, const ToolPose& pose, double tool_length,
                                 const AxisPositions& previous) {
  const RotaryAxes rotary(machine);
  const auto found = rotary.solve(pose.axis.normalized());
  if (!found) return found.error();
  InverseSolutions solutions;
  for (const OrientationSolution& s : *found) {
    solutions.push_back(
        with_linear_axes(machine, rotary, pose, tool_length, s, rotary.angles(previous)));
  }
  if (solutions.size() == 2 && comes_first(solutions[1], solutions[0], previous)) {
    std::swap(solutions[0], solutions[1]);
  }
  return solutions;
}

Result<std::vector<InverseSolution>> all_solutions(const Machine& machine, const ToolPose& pose,
                                                   double tool_length,
                                                   const AxisPositions& previous) {
  const auto found = inverse(machine, pose, tool_length, previous);
  if (!found) return found.error();
  const RotaryAxes rotary(machine);
  std::vector<InverseSolution> solutions;
  for (const InverseSolution& nearest : *found) {
    // Full turns change no linear axis.
    std::vector<InverseSolution> shifted{nearest};
    for (std::size_t i = 0; i < rotary.count() && !nearest.singular; ++i) {
      const AxisLetter letter = rotary.joint(i).letter;
      std::vector<InverseSolution> more;
      for (const InverseSolution& s : shifted) {
        for (const double q : turns_of(rotary.joint(i), s.axes[letter], previous[letter])) {
          more.push_back(s);
          more.back().axes[letter] = q;
        }
      }
      shifted = std::move(more);
    }
    solutions.insert(solutions.end(), shifted.begin(), shifted.end());
  }
  std::stable_sort(solutions.begin(), solutions.end(),
                   [&](const InverseSolution& a, const InverseSolution& b) {
                     return comes_first(a, b, previous);
                   });
  return solutions;
}

bool within_travel(const Machine& machine, const AxisPositions& q) {
  const auto within = [&](const Joint& joint) { return within_travel(joint, q[joint.letter]); };
  return std::all_of(machine.tool_chain().begin(), machine.tool_chain().end(), within) &&
         std::all_of(machine.work_chain().begin(), machine.work_chain().end(), within);
}

std::vector<std::string> travel_violations(const Machine& machine, const AxisPositions& q) {
  std::vector<std::string> violations;
  for (const Joint& joint : machine.joints()) {
    const double position = q[joint.letter];
    if (within_travel(joint, position)) continue;
    const double scale = joint.rotary() ? kDegPerRad : 1.0;
    if (joint.endless) {
      violations.push_back(fmt::format("{} = {:g} deg, more than 1000 turns", to_char(joint.letter),
                                       position * scale));
      continue;
    }
    violations.push_back(fmt::format("{} = {:.4f} {}, travel {:g} .. {:g}", to_char(joint.letter),
                                     position * scale, joint.rotary() ? "deg" : "mm",
                                     joint.travel.lo * scale, joint.travel.hi * scale));
  }
  return violations;
}

}  // namespace frustum::kinematics

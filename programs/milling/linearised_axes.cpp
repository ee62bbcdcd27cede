#include "programs/milling/linearised_axes.hpp"

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::kAxisLetters;
using kinematics::Machine;
using kinematics::nominal_pose;
using kinematics::place_tip;

AxisPositions halfway(const AxisPositions& a, const AxisPositions& b) {
  AxisPositions q;
  for (const AxisLetter letter : kAxisLetters) q[letter] = 0.5 * (a[letter] + b[letter]);
  return q;
}

void split(const Machine& machine, const AxisPositions& from, const AxisPositions& to,
           double length, double tolerance, int depth, std::vector<AxisPositions>& out) {
  const AxisPositions middle = halfway(from, to);
  const Vec3 straight = 0.5 * (nominal_pose(machine, from, length).translation +
                               nominal_pose(machine, to, length).translation);
  const double off = (nominal_pose(machine, middle, length).translation - straight).norm();
  constexpr int kDeepest = 16;  // 65,536 points a move
  if (off <= tolerance || depth >= kDeepest) {
    out.push_back(to);
    return;
  }
  const AxisPositions placed = place_tip(machine, straight, length, middle);
  split(machine, from, placed, length, tolerance, depth + 1, out);
  split(machine, placed, to, length, tolerance, depth + 1, out);
}

}  // namespace

std::vector<AxisPositions> linearised(const Machine& machine, const AxisPositions& from,
                                      const AxisPositions& to, double tool_length,
                                      double tolerance) {
  std::vector<AxisPositions> positions;
  split(machine, from, to, tool_length, tolerance, 0, positions);
  return positions;
}

}  // namespace frustum::programs

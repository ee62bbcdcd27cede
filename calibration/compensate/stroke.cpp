#include "calibration/compensate/stroke.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/compensate/pose_distance.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/actual_inverse.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::calibration {

using kinematics::ApproachProfile;
using kinematics::ApproachTracker;
using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::AxisState;
using kinematics::GeometricErrors;
using kinematics::kAxisLetters;
using kinematics::ToolPose;

namespace {

// Jumps settle in three or four, a bracket gains a digit in two.
constexpr int kRounds = 32;
// Of a direction of approach: that share of a reversal.
constexpr double kSameHeading = 1e-4;
// What an axis comes back over from the other side, mm or rad: above the last decimal of a word.
constexpr double kOtherSide = 1e-3;
constexpr double kOtherSideRotary = 1e-5;
// From this round on an axis that either direction of approach would move the other way is held: it
// stays where it is, mm or rad, instead of going back by no more than that much.
constexpr int kHoldingRound = 6;
constexpr double kHeldBack = 2e-5, kHeldBackRotary = 2e-7;
}  // namespace

double StrokeSolver::Bracket::next(double assumed, double found) {
  // Play never takes a direction beyond +-1, so that an answer is between.
  (found > assumed ? lo : hi) = assumed;
  substitutes = !substitutes;
  return substitutes && found >= lo && found <= hi ? found : 0.5 * (lo + hi);
}

StrokeSolver::StrokeSolver(const kinematics::Machine& machine, const GeometricErrors& errors,
                           const ProgrammedFrame& frame, const WantedBlock& wanted)
    : machine_(machine), errors_(errors), frame_(frame), wanted_(wanted) {}

Words StrokeSolver::corrected(double u, const AxisPositions& heading) const {
  const AxisState nominal(wanted_.axes(u), heading);
  return as_written(frame_.words_of(kinematics::actual_inverse(machine_, errors_, wanted_.pose(u),
                                                               wanted_.tool_length(), nominal)));
}

ApproachProfile StrokeSolver::follow(ApproachTracker& tracker, const Words& from,
                                     const Words& to) const {
  if (!tracker.follows_any()) return tracker.follow({}, 1);
  return tracker.follow(
      [frame = frame_, from, to](double t) { return frame.axes_of(between(from, to, t)); },
      kinematics::least_parts(frame_.axes_of(from), frame_.axes_of(to)));
}

ToolPose StrokeSolver::actual(const AxisState& at) const {
  return kinematics::tool_pose(
      kinematics::actual_pose(machine_, errors_, at, wanted_.tool_length()));
}

bool StrokeSolver::jumps(AxisLetter axis) const { return errors_[axis].lost_motion == 0.0; }

bool StrokeSolver::agree(const AxisPositions& a, const AxisPositions& b) const {
  return std::ranges::all_of(kAxisLetters, [&](AxisLetter axis) {
    return std::abs(a[axis] - b[axis]) <= (jumps(axis) ? 0.0 : kSameHeading);
  });
}

bool StrokeSolver::asks_for_turn(const AxisPositions& leaving,
                                 const AxisPositions& corrected_for) const {
  return std::ranges::any_of(kAxisLetters, [&](AxisLetter axis) {
    return jumps(axis) && leaving[axis] != corrected_for[axis];
  });
}

Stroke StrokeSolver::solve(const CorrectedPlace& at, double from, double to, bool may_turn) const {
  Stroke stroke{.from = from, .to = to};
  AxisPositions leaving = at.tracker.heading(), arriving = leaving;
  std::array<Bracket, kAxisLetters.size()> at_start{}, at_end{};
  AxisPositions other_side;  // of axes that come back over it: their direction
  AxisPositions held_to;     // of axes that are held: their direction
  for (int round = 0; round < kRounds && !stroke.settled; ++round) {
    ApproachTracker tracker = at.tracker;
    stroke.turn.clear();
    stroke.start = as_written(frame_.words_of(at.q));
    if (may_turn && asks_for_turn(leaving, at.corrected_for)) {
      const Words turned = held(stroke.start, corrected(from, leaving));
      AxisPositions beyond = frame_.axes_of(turned);
      for (const AxisLetter axis : kAxisLetters) {
        beyond[axis] -=
            other_side[axis] * (kinematics::is_rotary(axis) ? kOtherSideRotary : kOtherSide);
      }
      if (!(other_side == AxisPositions{})) {
        stroke.turn.push_back(as_written(frame_.words_of(beyond)));
      }
      if (!stroke.turn.empty() || !same(turned, stroke.start)) stroke.turn.push_back(turned);
      for (const Words& words : stroke.turn) {
        (void)follow(tracker, stroke.start, words);
        stroke.start = words;
      }
    }
    const Words end = corrected(to, arriving);
    stroke.end = tracker.follows_any() ? held(stroke.start, end) : end;
    if (!(held_to == AxisPositions{})) hold(stroke, tracker, held_to);
    stroke.approach = follow(tracker, stroke.start, stroke.end);
    stroke.corrected_for = arriving;
    const AxisPositions left = stroke.approach.after(0.0), arrived = tracker.heading();
    stroke.settled = agree(arrived, arriving) && (!may_turn || agree(left, leaving));
    if (stroke.settled) break;

    const AxisPositions start_q = frame_.axes_of(stroke.start), end_q = frame_.axes_of(stroke.end);
    bool turned = false;
    for (const AxisLetter axis : kAxisLetters) {
      const bool moves = std::abs(end_q[axis] - start_q[axis]) > kinematics::least_motion(axis);
      if (jumps(axis) && left[axis] != leaving[axis] && !moves && !stroke.turn.empty()) {
        other_side[axis] = leaving[axis];
        continue;
      }
      const auto i = static_cast<std::size_t>(axis);
      if (jumps(axis) && (left[axis] != leaving[axis] || arrived[axis] != arriving[axis]) &&
          round >= kHoldingRound && held_to[axis] == 0.0) {
        held_to[axis] = at.corrected_for[axis] != 0.0 ? at.corrected_for[axis] : left[axis];
        leaving[axis] = arriving[axis] = held_to[axis];
        turned = true;
        continue;
      }
      if (held_to[axis] != 0.0) continue;
      if (jumps(axis)) {
        turned = turned || leaving[axis] != left[axis] || arriving[axis] != arrived[axis];
        leaving[axis] = left[axis];
        arriving[axis] = arrived[axis];
        continue;
      }
      if (std::abs(left[axis] - leaving[axis]) > kSameHeading) {
        leaving[axis] = at_start.at(i).next(leaving[axis], left[axis]);
      }
      if (std::abs(arrived[axis] - arriving[axis]) > kSameHeading) {
        arriving[axis] = at_end.at(i).next(arriving[axis], arrived[axis]);
      }
    }
    if (turned) at_start = at_end = {};
  }
  find_turns(stroke);
  return stroke;
}

void StrokeSolver::hold(Stroke& stroke, const ApproachTracker& tracker,
                        const AxisPositions& direction) const {
  AxisPositions end = frame_.axes_of(stroke.end);
  for (const AxisLetter axis : kAxisLetters) {
    const auto furthest = tracker.furthest(axis);
    if (direction[axis] == 0.0 || !furthest) continue;
    const double back = direction[axis] * (*furthest - end[axis]);
    const bool rotary = kinematics::is_rotary(axis);
    if (back > 0.0 && back < (rotary ? kHeldBackRotary : kHeldBack)) end[axis] = *furthest;
  }
  stroke.end = as_written(frame_.words_of(end));
}

void StrokeSolver::find_turns(Stroke& stroke) const {
  stroke.turns = !stroke.settled || !stroke.approach.turning_points().empty();
  for (const double t : stroke.approach.turning_points()) {
    if (t == 0.0) continue;
    const AxisPositions before = stroke.approach.at(t), after = stroke.approach.after(t);
    for (const AxisLetter axis : kAxisLetters) {
      if (jumps(axis) && before[axis] != after[axis] && !stroke.jumps_at) stroke.jumps_at = t;
    }
  }
}

bool StrokeSolver::follows(const Stroke& stroke, double bound, double axis_bound) const {
  const ToolPose start = wanted_.pose(stroke.from), end = wanted_.pose(stroke.to);
  const Vec3 along = end.tip - start.tip;
  const double length2 = along.squaredNorm();
  const auto passes = [&](double u) {
    const ToolPose target = wanted_.pose(u);
    const double t = share_of_way(start, end, target);
    const AxisPositions q = frame_.axes_of(between(stroke.start, stroke.end, t));
    const AxisPositions heading = stroke.approach.at(t, q);
    const ToolPose tool = actual({q, heading});
    const Vec3 off = tool.tip - target.tip;
    // Off along the path is only early or late.
    const Vec3 across = length2 > 0.0 ? Vec3(off - along * (along.dot(off) / length2)) : off;
    if (across.norm() > bound) return false;
    const double turned = angle_between(tool.axis, target.axis);
    return turned <= axis_bound || turned <= axis_bound + axis_left(u, heading);
  };
  if (!std::ranges::all_of(wanted_.samples_between(stroke.from, stroke.to), passes)) return false;
  if (!stroke.turns) return true;
  // Play is taken up over any length.
  return std::ranges::all_of(std::array{0.25, 0.5, 0.75}, [&](double t) {
    return passes(stroke.from + t * (stroke.to - stroke.from));
  });
}

double StrokeSolver::axis_left(double u, const AxisPositions& heading) const {
  const ToolPose wanted = wanted_.pose(u);
  const AxisState nominal(wanted_.axes(u), heading);
  const AxisPositions q =
      kinematics::actual_inverse(machine_, errors_, wanted, wanted_.tool_length(), nominal);
  return angle_between(actual({q, heading}).axis, wanted.axis);
}

}  // namespace frustum::calibration

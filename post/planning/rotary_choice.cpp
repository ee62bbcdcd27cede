#include "post/planning/rotary_choice.hpp"

#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::post {

using kinematics::AxisPositions;
using kinematics::kRotaryAxes;
using kinematics::PlannedPose;
using parser::AxisLetter;

std::optional<PlannedPose> RotaryChoice::choose(const PlannedBlock& block, const Vec3& tip,
                                                std::span<const parser::Motion> rest) {
  by_vector_ = block.tool_axis.has_value();
  const std::optional<PlannedPose> planned =
      block.tool_axis ? next_planned(rest) : written_end(block, tip);
  if (planned) end_ = with_rotary_of(state_.q, planned->axes);
  return planned;
}

AxisPositions RotaryChoice::as_words(const PlannedBlock& block) {
  by_vector_ = false;
  end_ = state_.q;
  for (const AxisLetter letter : kRotaryAxes) {
    if (block.end[letter]) end_[letter] = turned(letter, *block.end[letter]);
  }
  return end_;
}

void RotaryChoice::follow_vector(const AxisPositions& end) {
  by_vector_ = true;
  end_ = end;
}

void RotaryChoice::set(AxisLetter letter, double position) {
  turns_[letter] = 0.0;
  written_[letter] = position;
  flipped_ = false;
}

// A rotary word, with the full turns that a rewind took off, or the shortest way.
double RotaryChoice::turned(AxisLetter letter, double word) const {
  const auto path = state_.modes().rotary_path(letter);
  if (path == parser::RotaryPath::as_programmed) return word + turns_[letter];
  return kinematics::turn_to(*state_.machine.joint(letter), word, state_.q[letter], path);
}

// Rotary words as they are while the axes are on the solution that the program means; else the
// positions nearest to where they are that point the tool the same way.
std::optional<PlannedPose> RotaryChoice::written_end(const PlannedBlock& block, const Vec3& tip) {
  PlannedPose as_written{.axes = state_.q};
  for (const AxisLetter letter : kRotaryAxes) {
    if (block.end[letter]) written_[letter] = *block.end[letter];
    if (block.end[letter]) as_written.axes[letter] = turned(letter, *block.end[letter]);
  }
  if (!flipped_) {
    return state_.rotary_within_travel(as_written.axes) ? as_written : turned_back(as_written, tip);
  }
  const AxisPositions words = with_rotary_of(state_.q, written_);
  const Vec3 axis = kinematics::nominal_pose(state_.machine, words, 0.0).rotation.col(2);
  const auto nearest = kinematics::nearest_orientation(state_.machine, state_.q, axis);
  if (nearest) return PlannedPose{.axes = *nearest};
  as_written.axes = words;
  return turned_back(as_written, tip);
}

// The words are out of travel: the same direction by other positions.
std::optional<PlannedPose> RotaryChoice::turned_back(const PlannedPose& written, const Vec3& tip) {
  const Vec3 axis = kinematics::nominal_pose(state_.machine, written.axes, 0.0).rotation.col(2);
  const auto planned = plan_poses({.poses = {{tip, axis}}, .from_here = true});
  if (planned.empty()) return {};
  const PlannedPose next = planned.front();
  for (const AxisLetter letter : kRotaryAxes) {
    const double off = next.axes[letter] - written.axes[letter];
    const double turns = kTurn * std::round(off / kTurn);
    turns_[letter] += turns;
    constexpr double kSameAngle = 1e-6;  // rad
    if (std::abs(off - turns) > kSameAngle) flipped_ = true;
  }
  return next;
}

// Vectors are planned together, from here to where something else moves the axes.
std::optional<PlannedPose> RotaryChoice::next_planned(std::span<const parser::Motion> rest) {
  if (planned_.empty()) {
    const kinematics::ControllerState& program = state_.controller;
    const auto planned =
        plan_poses(vector_run(rest, program.tip_in_words(state_.q), program.table_from_words()));
    planned_.assign(planned.begin(), planned.end());
    if (planned_.empty()) return {};
  }
  const PlannedPose next = planned_.front();
  planned_.pop_front();
  return next;
}

// Empty: there is no way, and the problem is noted.
std::vector<PlannedPose> RotaryChoice::plan_poses(const PoseRun& run) {
  // What reads vectors takes the nearest solution; without lengths travels cannot be looked at.
  const bool nearest = state_.options.output == OutputForm::vectors || state_.lengths_missing();
  auto planned = choose_axes(state_.machine, run, state_.q, state_.length(),
                             nearest ? AxisChoice::nearest : AxisChoice::along_the_path,
                             state_.options.pole_tolerance);
  if (planned) return *std::move(planned);
  state_.fail(planned.error().front());
  return {};
}

}  // namespace frustum::post

// Where the rotary axes of a block go: as written, by the plan of a run of tool vectors, or, out of
// travel, to other positions of the same direction.
//
// Units  : mm, rad; frame: table
// Errors : noted in the plan state: directions out of reach, no way within the travels
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "kinematics/model/rotary_plan.hpp"
#include "post/planning/plan_state.hpp"
#include "post/planning/planned_block.hpp"
#include "post/planning/pose_run.hpp"

namespace frustum::post {

class RotaryChoice {
 public:
  explicit RotaryChoice(PlanState& state) : state_(state) {}

  // Where the rotary axes go. `tip`: of the block's end, in the table frame; `rest`: the program
  // from this block on. Nothing: the problem is noted.
  std::optional<kinematics::PlannedPose> choose(const PlannedBlock& block, const Vec3& tip,
                                                std::span<const parser::Motion> rest);
  // As written, words being axis positions.
  [[nodiscard]] kinematics::AxisPositions as_words(const PlannedBlock& block);
  // On a great circle the way decides.
  void follow_vector(const kinematics::AxisPositions& end);
  // Moved in machine coordinates: what a rewind changed is over.
  void set(parser::AxisLetter letter, double position);

  // Of the block at work: where its rotary axes end, and whether it names its direction by a
  // vector.
  [[nodiscard]] const kinematics::AxisPositions& end() const { return end_; }
  [[nodiscard]] bool by_vector() const { return by_vector_; }

 private:
  [[nodiscard]] double turned(parser::AxisLetter letter, double word) const;
  std::optional<kinematics::PlannedPose> written_end(const PlannedBlock& block, const Vec3& tip);
  std::optional<kinematics::PlannedPose> turned_back(const kinematics::PlannedPose& written,
                                                     const Vec3& tip);
  std::optional<kinematics::PlannedPose> next_planned(std::span<const parser::Motion> rest);
  std::vector<kinematics::PlannedPose> plan_poses(const PoseRun& run);

  PlanState& state_;
  kinematics::AxisPositions turns_{};    // full turns added to the program's rotary words
  kinematics::AxisPositions written_{};  // the program's rotary words
  bool flipped_ = false;                 // a rewind went to the other solution for the tool axis
  kinematics::AxisPositions end_{};
  bool by_vector_ = false;
  std::deque<kinematics::PlannedPose> planned_{};
};

}  // namespace frustum::post

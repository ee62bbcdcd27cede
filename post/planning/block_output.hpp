// A block, or a part of it, in the words of the output.
//
// Units  : mm, rad, minutes
// Errors : none
#pragma once

#include <optional>

#include "post/planning/output_arc.hpp"
#include "post/planning/plan_state.hpp"
#include "post/planning/planned_block.hpp"
#include "post/planning/rotary_choice.hpp"

namespace frustum::post {

class BlockOutput {
 public:
  BlockOutput(PlanState& state, const RotaryChoice& rotary) : state_(state), rotary_(rotary) {}

  // Writes the part; the axes are then at `end`.
  void write(const BlockPart& part, const kinematics::AxisPositions& end,
             const std::optional<ArcImage>& arc);
  // The block's arc in the output's words under `wanted`; nothing where it is none or may not be
  // one. `table_from_in`: directions of the words that the arc is programmed in, `start`: its start
  // in them.
  [[nodiscard]] std::optional<ArcImage> arc_image(const PlannedBlock& block,
                                                  const parser::CompensationChange& wanted,
                                                  const Mat3& table_from_in,
                                                  const Vec3& start) const;

 private:
  [[nodiscard]] parser::AxisTarget given_letters(const PlannedBlock& block, bool whole) const;
  [[nodiscard]] parser::AxisTarget words_at(const kinematics::AxisPositions& q,
                                            const parser::AxisTarget& letters) const;
  [[nodiscard]] parser::Feed feed_of(const BlockPart& part, const kinematics::AxisPositions& end,
                                     bool arc) const;

  PlanState& state_;
  const RotaryChoice& rotary_;
};

}  // namespace frustum::post

// Probing: G38.2 to G38.5, and Fanuc's G31.
#include "parser/interpret/block_executor.hpp"

#include "core/units.hpp"

namespace frustum::parser {
namespace {

constexpr int kProbed = 5061;    // the place, nine axes
constexpr int kProbeMet = 5070;  // 1 when the probe met the part

}  // namespace

// The program goes on as if the probe had come to its end and met nothing.
BlockExecutor::Outcome BlockExecutor::probe(const BlockWords& words, const Movement& movement) {
  const AxisTarget before = position_.target();
  if ((words.given() & kAxisWords).empty()) {
    return fail(movement.column, "probe-end-missing"_id, "a probing move without an end",
                "give X Y Z of its end");
  }
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = set_targets(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  const AxisTarget end = end_of(words);
  if (position_.target() == before) {
    return fail(movement.column, "probe-empty"_id, "the probing move ends where it starts",
                "give an end that lies behind what it is to meet");
  }
  const auto feed = feed_for(words, movement, true);
  if (!feed) return feed.error();
  const bool away = movement.motion >= MotionMode::probe_away;
  const bool must_meet =
      movement.motion == MotionMode::probe_towards || movement.motion == MotionMode::probe_away;
  emit(movement.column, Probe{end, state_.tool_axis, *feed, away, must_meet});
  for (const AxisLetter axis : kAxisLetters) {
    const int index = kProbed + static_cast<int>(axis);
    const auto& value = position_[axis];
    if (value) parameters_.set(index, *value / (is_rotary(axis) ? kRadPerDeg : unit_scale()));
  }
  if (rules_.dialect == Dialect::linuxcnc) parameters_.set(kProbeMet, 0.0);
  return Done{};
}

}  // namespace frustum::parser

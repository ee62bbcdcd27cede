#include "parser/interpret/moves/probing.hpp"

#include <fmt/format.h>

#include <string>

#include "core/units.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kProbed = 5061;    // the place, nine axes
constexpr int kProbeMet = 5070;  // 1 when the probe met the part

// What the cycles of Klartext measure: from the first to the last Q.
struct Results {
  int first;
  int last;
};
constexpr Results kResults[] = {{115, 119}, {141, 149}, {150, 199}, {950, 999}};

}  // namespace

Outcome probe(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const AxisTarget before = state.position.target();
  if ((words.given() & kAxisWords).empty()) {
    return fail(state, movement.column, "probe-end-missing"_id, "a probing move without an end",
                "give X Y Z of its end");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  const AxisTarget end = end_of(state, words);
  if (state.position.target() == before) {
    return fail(state, movement.column, "probe-empty"_id, "the probing move ends where it starts",
                "give an end beyond what it is to meet");
  }
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  const bool away = movement.motion >= MotionMode::probe_away;
  const bool must_meet =
      movement.motion == MotionMode::probe_towards || movement.motion == MotionMode::probe_away;
  emit(state, movement.column, Probe{end, state.modes.tool_axis, *feed, away, must_meet});
  for (const AxisLetter axis : kAxisLetters) {
    const int index = kProbed + static_cast<int>(axis);
    const auto& value = state.position[axis];
    if (value)
      state.parameters.set(index, *value / (is_rotary(axis) ? kRadPerDeg : unit_scale(state)));
  }
  if (state.rules.dialect == Dialect::linuxcnc) state.parameters.set(kProbeMet, 0.0);
  return Done{};
}

Outcome pass_probing(InterpreterState& state, const BlockWords& words) {
  assume(state, words[CodeGroup::non_modal].column, "TCH PROBE",
         "the probe finds part, datum and tool where the setup has them");
  for (const Results& results : kResults) {
    for (int number = results.first; number <= results.last; ++number) {
      const std::string name = fmt::format("Q{}", number);
      state.parameters.set(name, state.parameters.unknown_value(name));
    }
  }
  forget(state, kLinearWords, PositionLoss::probing_cycle);
  return Done{};
}

}  // namespace frustum::parser

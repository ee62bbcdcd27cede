#include "parser/interpret/cycles/rigid_mode.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <utility>

namespace frustum::parser {
namespace {

bool is_tap(MotionMode motion) {
  return motion == MotionMode::tap || motion == MotionMode::tap_left;
}

// The G word of another motion.
bool names_other_motion(const BlockWords& words) {
  return words.has(CodeGroup::motion) &&
         !is_tap(words.value_or(CodeGroup::motion, MotionMode::none));
}

// The word that ends the mode. One of a motion before the first hole is an alarm if it moves an
// axis.
const GivenCode* end_of_mode(const BlockWords& words, bool has_tapped) {
  if (has_tapped && names_other_motion(words)) return &words[CodeGroup::motion];
  for (const CodeGroup group : {CodeGroup::cycle, CodeGroup::tool_change, CodeGroup::spindle}) {
    if (words.has(group)) return &words[group];
  }
  return nullptr;
}

// G80 after its holes is how a program ends it.
void end_mode(InterpreterState& state, const GivenCode& by) {
  RigidMode& mode = state.modes.rigid_mode;
  const bool is_g = by.code->letter == 'G';
  if (!is_g || !mode.has_tapped) {
    assume(state, by.column, "M29",
           fmt::format("{} ends the rigid mode of M29{}", by.code->name(),
                       mode.has_tapped ? "" : " before any hole"));
  }
  mode = {};
}

// Of the words after which the tap is none of this mode, or where a control stops.
Outcome check_way_to_hole(const InterpreterState& state, const Movement& movement) {
  const RigidMode& mode = state.modes.rigid_mode;
  if (!mode.on || mode.has_tapped) return Done{};
  struct Interruption {
    std::uint32_t line;  // 0: there was none
    const char* what;
    const char* alarm;
    const char* hint;
  };
  const std::array interruptions{Interruption{mode.axes_moved, "the axes move", "PS0204",
                                              "write M29 behind the last move before the tap"},
                                 Interruption{mode.speed_given, "the speed changes", "PS0203",
                                              "write S beside M29, or before it"}};
  for (const Interruption& by : interruptions) {
    if (by.line == 0) continue;
    return fail(state, movement.column, "rigid-tap-interrupted"_id,
                fmt::format("{} on line {}, between M29 and its tap: the control stops there "
                            "(alarm {})",
                            by.what, by.line, by.alarm),
                by.hint);
  }
  return Done{};
}

}  // namespace

Outcome set_rigid_mode(InterpreterState& state, const BlockWords& words) {
  RigidMode& mode = state.modes.rigid_mode;
  if (words.has(CodeGroup::tapping)) {
    mode = {.on = true};
    return Done{};
  }
  if (!mode.on) return Done{};
  if (const GivenCode* end = end_of_mode(words, mode.has_tapped)) {
    end_mode(state, *end);
    return Done{};
  }
  const GivenCode& plane = words[CodeGroup::plane];
  if (plane.code != nullptr && static_cast<Plane>(plane.code->value) != state.modes.plane) {
    return fail(state, plane.column, "rigid-tap-interrupted"_id,
                plane.code->name() +
                    " in the rigid mode of M29: the control stops here "
                    "(alarm PS0206)",
                "end it by G80 before, and write M29 again behind it");
  }
  return Done{};
}

void watch_rigid_mode(InterpreterState& state, const BlockWords& words) {
  RigidMode& mode = state.modes.rigid_mode;
  if (!mode.on || mode.has_tapped || words.has(CodeGroup::tapping)) return;
  const std::uint32_t line = state.at_work.block->line;
  if (words.has('S') && mode.speed_given == 0) mode.speed_given = line;
  if (state.at_work.moved) {
    if (mode.axes_moved == 0) mode.axes_moved = line;
  } else if (names_other_motion(words)) {
    end_mode(state, words[CodeGroup::motion]);
  }
}

// By the feed or the way of a revolution.
Result<std::optional<RigidTap>> rigid_tap_of(InterpreterState& state, const Movement& movement,
                                             const Feed& feed) {
  const MotionMode kind = state.modes.cycle->last;
  // Controls that turn the spindle themselves need no M29.
  const bool turns_itself =
      state.rules.dialect == Dialect::fanuc && state.modes.spindle == SpindleDirection::off;
  if (!is_tap(kind)) return std::optional<RigidTap>{};
  if (auto done = check_way_to_hole(state, movement); !done) return std::move(done).error();
  RigidMode& mode = state.modes.rigid_mode;
  if (!mode.on && !turns_itself) return std::optional<RigidTap>{};
  const double speed = state.modes.spindle_speed;
  if (!(speed > 0.0)) {
    return fail(state, movement.column, "cycle-speed-missing"_id,
                "a rigid tap without a spindle speed", "give S beside M29");
  }
  if (feed.mode == FeedMode::inverse_time) {
    return fail(state, movement.column, "cycle-inverse-time"_id, "a rigid tap in G93",
                "give the feed per minute (G94), or the lead (G95)");
  }
  if (!(feed.value > 0.0)) {
    return fail(state, movement.column, "feed-missing"_id, "a rigid tap without a feed",
                "give F: with the speed of the spindle it makes the lead");
  }
  if (!mode.on) {
    assume(state, movement.column, "tap with the spindle at rest",
           "the control turns the spindle itself, in and out: a rigid tap");
  }
  if (state.modes.cycle->peck.value_or(0.0) > 0.0) {
    assume(state, movement.column, "rigid tap with Q",
           "in one stroke: how it goes back after each Q is a parameter of the control");
  }
  assume(state, movement.column, "rigid tap", "the spindle is at rest when the hole is done");
  mode.has_tapped = mode.on;
  RigidTap tap;
  tap.lead = feed.mode == FeedMode::per_revolution ? feed.value : feed.value / speed;
  if (kind == MotionMode::tap_left) tap.lead = -tap.lead;
  tap.speed = speed;
  tap.after = {SpindleDirection::off, speed};
  return std::optional(tap);
}

}  // namespace frustum::parser

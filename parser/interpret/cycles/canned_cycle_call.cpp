#include "parser/interpret/cycles/canned_cycle_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/cycles/bolt_holes.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/rigid_mode.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/polar_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxHoles = 99'999;
constexpr double kMostMoves = 200'000;  // of one block

bool needs_peck(MotionMode cycle) {
  return cycle == MotionMode::peck || cycle == MotionMode::peck_short;
}

bool words_shift_by_q(MotionMode cycle) {
  return cycle == MotionMode::fine_bore || cycle == MotionMode::bore_back;
}

bool needs_dwell(MotionMode cycle) {
  return cycle == MotionMode::drill_dwell || cycle == MotionMode::bore_stop ||
         cycle == MotionMode::bore_manual || cycle == MotionMode::bore_dwell;
}

// G81 of Fagor, which has no R.
bool depth_is_by_i(const InterpreterState& state, const BlockWords& words,
                   const CannedCycle& cycle) {
  if (state.rules.dialect != Dialect::fanuc || cycle.last != MotionMode::drill) return false;
  if (words.has('R') || words.has(CodeGroup::bolt_holes)) return false;
  return cycle.depth_by_i || (!cycle.level && words.has('I'));
}

// I and J, which most cycles would leave aside.
Outcome check_shift(const InterpreterState& state, const BlockWords& words,
                    const CannedCycle& cycle) {
  if (cycle.depth_by_i && words.has('K') && words['K'].value != 0.0) {
    return fail(state, words['K'].column, "word-ambiguous"_id,
                fmt::format("{} beside I in G81", words.text_of('K')),
                "Fagor dwells and Fanuc repeats; write G82 with R, Z and P, or L");
  }
  if (words_shift_by_q(cycle.last) || words.has(CodeGroup::bolt_holes)) return Done{};
  for (const char letter : {'I', 'J'}) {
    if (!words.has(letter) || words[letter].value == 0.0) continue;
    if (letter == 'I' && cycle.depth_by_i) continue;
    return fail(state, words[letter].column, "word-unused"_id,
                fmt::format("{} has no meaning in this cycle", words.text_of(letter)),
                "give depths by R, Z and Q");
  }
  return Done{};
}

std::optional<double> depth_before(InterpreterState& state, AxisLetter depth_axis) {
  // The length of the tool has been switched on with no move of its own.
  if (const auto programmed = state.position.programmed(depth_axis)) {
    state.position.set(depth_axis, *programmed);
  }
  return state.position[depth_axis];
}

// The depth from which the cycle has begun, where its moves depend on it. After a tool change it is
// the machine's.
Outcome settle_initial_level(InterpreterState& state, const Movement& movement, CannedCycle& cycle,
                             AxisLetter depth_axis) {
  const bool needs_it = cycle.level_is_step || cycle.last == MotionMode::bore_back;
  if (!needs_it && !state.modes.retract_to_initial && !state.rules.cycles.start_from_initial) {
    return Done{};
  }
  const bool known = cycle.initial || (cycle.untold_change && !needs_it);
  if (!known) {
    return fail(
        state, movement.column, state.position.unknown_id(depth_axis),
        fmt::format("the cycle starts at an unknown {}: {}", to_char(depth_axis),
                    state.position.why_unknown(depth_axis)),
        fmt::format("program {} in absolute coordinates (G90) before it", to_char(depth_axis)));
  }
  const auto change = std::exchange(cycle.untold_change, std::nullopt);
  if (!change) return Done{};
  const std::string_view taken = cycle.initial    ? "that of the cycle before it"
                                 : change->height ? "where it was before, or R where that is higher"
                                                  : "R";
  if (!cycle.initial) cycle.initial = std::max(change->height.value_or(*cycle.level), *cycle.level);
  // Of each change of tool.
  emit(
      state, movement.column,
      Event{"initial level",
            fmt::format("{} is not known since the tool change on line {}: the initial level is {}",
                        to_char(depth_axis), change->line, taken),
            EventGrade::assumed});
  return Done{};
}

// Words that the block gives replace those in force.
Outcome set_cycle(InterpreterState& state, const BlockWords& words, const Movement& movement,
                  AxisLetter depth_axis) {
  const char depth_letter = to_char(depth_axis);
  const bool goes_on = state.modes.cycle && is_cycle(state.modes.cycle->last);
  CannedCycle cycle = goes_on ? *state.modes.cycle : CannedCycle{};
  if (goes_on && state.rules.cycles.words_end_with_their_g_word && cycle.last != movement.motion) {
    cycle = CannedCycle{.initial = cycle.initial, .untold_change = cycle.untold_change};
  }
  if (!goes_on) cycle.initial = depth_before(state, depth_axis);
  if (depth_axis == AxisLetter::Z && state.position.tool_change()) {
    cycle.untold_change = state.position.tool_change();
  }
  cycle.last = movement.motion;
  const auto read = [&](char letter, std::optional<double>& value) {
    if (words.has(letter)) value = length_of(state, words[letter].value);
  };
  cycle.depth_by_i = depth_is_by_i(state, words, cycle);
  if (auto done = check_shift(state, words, cycle); !done) return done;
  const char level_letter = cycle.depth_by_i ? depth_letter : 'R';
  const char bottom_letter = cycle.depth_by_i ? 'I' : depth_letter;
  read(level_letter, cycle.level);
  read(bottom_letter, cycle.bottom);
  const bool incremental = state.modes.distance == DistanceMode::incremental;
  const bool any_block = !state.rules.cycles.words_keep_their_mode;
  if (any_block || words.has(level_letter)) cycle.level_is_step = incremental;
  if (any_block || words.has(bottom_letter)) cycle.bottom_is_step = incremental;
  if (cycle.depth_by_i) {
    assume(
        state, movement.column, "cycle with I",
        fmt::format("{} is where feeding begins and I the bottom, as Fagor has it", depth_letter));
  }
  read('Q', cycle.peck);
  const bool milliseconds =
      state.rules.dialect == Dialect::fanuc && words.has('P') && !words['P'].decimal_point;
  const double seconds = milliseconds ? 1.0 / kMillisecondsPerSecond : 1.0;
  if (words.has('P')) cycle.dwell = words['P'].value * seconds;
  const PlaneAxes axes = axes_of(state.modes.plane);
  if (!words.has(CodeGroup::bolt_holes)) {
    read("IJK"[axes.u], cycle.shift_u);
    read("IJK"[axes.v], cycle.shift_v);
    read("IJK"[3 - axes.u - axes.v], cycle.back);
  }

  const auto missing = [&](char letter, std::string what) {
    return fail(state, movement.column, "cycle-word-missing"_id,
                fmt::format("the cycle has no {}", letter), std::move(what));
  };
  if (!cycle.level && state.rules.starts_with_rapid && cycle.initial) {
    assume(state, movement.column, "cycle without R", "feeding begins where the tool is");
    cycle.level = cycle.level_is_step ? 0.0 : *cycle.initial;
  }
  if (!cycle.level) return missing('R', "give R, where feeding begins");
  if (!cycle.bottom) {
    return missing(depth_letter, fmt::format("give {}, the bottom of the hole", depth_letter));
  }
  if (auto done = settle_initial_level(state, movement, cycle, depth_axis); !done) return done;
  if (needs_peck(cycle.last) && (!cycle.peck || *cycle.peck <= 0.0)) {
    return missing('Q', "give Q, the depth of a peck, above zero");
  }
  if (state.rules.dialect == Dialect::linuxcnc && needs_dwell(cycle.last) && !cycle.dwell) {
    return missing('P', "give P, the dwell at the bottom in seconds");
  }
  if (cycle.dwell.value_or(0.0) < 0.0) return missing('P', "P is a time that is not negative");
  const bool by_q = state.rules.cycles.tool_shift_by_q && words_shift_by_q(cycle.last);
  if (by_q && (!cycle.peck || *cycle.peck <= 0.0)) {
    return missing('Q', "give Q, the shift of the tool, above zero");
  }
  if (by_q) {
    cycle.shift_u = cycle.peck;
    cycle.shift_v = 0.0;
  }
  if (cycle.last == MotionMode::bore_back && !by_q &&
      (!cycle.shift_u || !cycle.shift_v || !cycle.back)) {
    return missing('I', "give I and J, the shift of the tool, and K, how far the bore goes up");
  }
  state.modes.cycle = cycle;
  return Done{};
}

}  // namespace

Outcome run_cycle(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const auto w = static_cast<AxisLetter>(3 - axes.u - axes.v);
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  if (state.modes.programmed_frame.scale != 1.0 ||
      state.modes.programmed_frame.mirrors.at(static_cast<std::size_t>(w))) {
    return fail(state, movement.column, "cycle-frame"_id,
                "a canned cycle where the depths are scaled or mirrored",
                fmt::format("end it before, by G50 or G50.1 {}0", to_char(w)));
  }
  if (auto done = set_cycle(state, words, movement, w); !done) return done;
  const CannedCycle& cycle = *state.modes.cycle;
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(state, words[rotary].column, "cycle-rotary"_id,
                fmt::format("{} in a canned cycle", words.text_of(rotary)),
                "turn the axes on the block before");
  }
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  const auto rigid = rigid_tap_of(state, movement, *feed);
  if (!rigid) return rigid.error();

  CycleDepths depths;
  // Where it is not known nothing depends on it.
  const double initial = cycle.initial.value_or(*cycle.level);
  depths.level = *cycle.level + (cycle.level_is_step ? initial : 0.0);
  depths.bottom = *cycle.bottom + (cycle.bottom_is_step ? depths.level : 0.0);
  depths.clear = state.modes.retract_to_initial ? std::max(initial, depths.level) : depths.level;
  if (state.modes.retract_to_initial && initial < depths.level &&
      state.rules.dialect == Dialect::fanuc) {
    assume(state, movement.column, "initial level",
           "the tool stays at R where the initial level of G98 is below it");
  }
  depths.feed_out = state.rules.cycles.feed_out_to_clearance ? depths.clear : depths.level;
  depths.peck = cycle.peck.value_or(0.0);
  depths.dwell = cycle.dwell.value_or(0.0);
  depths.back = cycle.back.value_or(0.0) + (cycle.bottom_is_step ? depths.bottom : 0.0);
  if (needs_peck(cycle.last) && depths.level - depths.bottom > kMostPecks * depths.peck) {
    return fail(state, movement.column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks), "give a larger Q");
  }
  depths.rigid = rigid->has_value();
  depths.out_by_hand = state.rules.cycles.hand_retract_ends_at_r;
  if (depths.out_by_hand && cycle.last == MotionMode::bore_manual) {
    assume(state, movement.column, "G88",
           "the tool is at R when the operator has drawn it out of the hole");
  }
  depths.from_level = state.rules.cycles.tool_shift_by_q && cycle.last == MotionMode::bore_back;
  if (depths.from_level) {
    depths.clear = initial;
    if (depths.bottom <= depths.level || initial <= depths.bottom) {
      return fail(
          state, movement.column, "cycle-depth"_id,
          fmt::format("G87 bores from R ({:g} mm) up to {} ({:g} mm), below the tool ({:g} mm)",
                      depths.level, to_char(w), depths.bottom, initial),
          "give R below the bore, the other depth above R, and start above both");
    }
  } else if (depths.bottom > depths.level) {
    return fail(state, movement.column, "cycle-depth"_id,
                fmt::format("the bottom of the hole ({:g} mm) is above R ({:g} mm)", depths.bottom,
                            depths.level),
                "give R above the bottom");
  }
  const auto bolts = bolt_places(state, words);
  if (!bolts) return bolts.error();
  const bool on_pattern = words.has(CodeGroup::bolt_holes);
  int holes = on_pattern ? static_cast<int>(bolts->size()) : 1;
  for (const char letter : {'L', 'K'}) {
    if (on_pattern) break;
    const bool repeats = letter == 'L' || state.rules.dialect == Dialect::fanuc;
    if (!repeats || !words.has(letter)) continue;
    const auto given = whole(state, words, letter, 0, kMaxHoles);
    if (!given) return given.error();
    holes = *given;
  }
  const auto rapid = [&](std::uint32_t column) {
    emit(state, column,
         Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  };
  const double height =
      state.rules.cycles.start_from_initial ? initial : state.position[w].value_or(initial);
  if (state.rules.cycles.rises_before_it_goes && holes > 0 && height < depths.level) {
    state.position.set(w, depths.level);
    rapid(movement.column);
  }
  // With G99 it goes up to a higher R on the way.
  if (state.rules.cycles.start_from_initial) {
    state.position.set(w, std::max(state.position[w].value_or(initial),
                                   state.modes.retract_to_initial ? depths.clear : depths.level));
  }
  Vec2 middle = Vec2::Zero();
  for (int hole = 0; hole < holes; ++hole) {
    if (hole == 0 || !on_pattern) {
      if (auto done = set_polar_target(state, words); !done) return done;
      if (auto done = set_place_in_plane(state, words); !done) return done;
    }
    for (const AxisLetter axis : {u, v}) {
      if (state.position[axis]) continue;
      return fail(
          state, movement.column, state.position.unknown_id(axis),
          fmt::format("the place of the hole is not known: {}", state.position.why_unknown(axis)),
          fmt::format("give {} on this block", to_char(axis)));
    }
    if (on_pattern) {
      if (hole == 0) middle = {*state.position[u], *state.position[v]};
      const Vec2 bolt = middle + bolts->at(static_cast<std::size_t>(hole));
      state.position.set(u, bolt.x());
      state.position.set(v, bolt.y());
    }
    rapid(movement.column);
    if (state.position[w] != depths.level && !depths.from_level) {
      state.position.set(w, depths.level);
      rapid(movement.column);
    }
    Vec3 centre = Vec3::Zero();
    for (const AxisLetter axis : {u, v}) {
      centre[static_cast<Eigen::Index>(axis)] = *state.position[axis];
    }
    const auto place = [&](double depth, bool shifted) {
      Vec3 point = centre;
      if (shifted) {
        point[axes.u] += state.modes.cycle->shift_u.value_or(0.0);
        point[axes.v] += state.modes.cycle->shift_v.value_or(0.0);
      }
      point[axes.w] = depth;
      return point;
    };
    const std::vector<CycleStep> steps = steps_at_hole(cycle.last, depths);
    if (static_cast<double>(holes) * static_cast<double>(steps.size()) > kMostMoves) {
      return fail(state, movement.column, "cycle-moves"_id,
                  fmt::format("the cycle makes more than {} moves", kMostMoves),
                  "give fewer repeats, or a larger Q");
    }
    if (*rigid) {
      tap_hole(state, steps, movement.column, place, **rigid);
    } else {
      drill(state, steps, movement.column, place, *feed, *feed);
    }
  }
  return Done{};
}

void drill(InterpreterState& state, const std::vector<CycleStep>& steps, std::uint32_t column,
           const PlaceInHole& place, const Feed& feed, const Feed& feed_out) {
  const SpindleDirection turned = state.modes.spindle;
  const auto turn = [&](SpindleDirection direction) {
    state.modes.spindle = direction;
    emit(state, column, SpindleChange{direction, state.modes.spindle_speed});
  };
  double depth = std::numeric_limits<double>::infinity();
  for (const CycleStep& step : steps) {
    switch (step.action) {
      case CycleAction::rapid:
      case CycleAction::feed: {
        const AxisTarget before = state.position.target();
        const Vec3 point = place(step.value, step.shifted);
        for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
          state.position.set(axis, point[static_cast<Eigen::Index>(axis)]);
        }
        const bool out = step.value > depth;
        const bool by_rapid =
            out && feed_out.mode == FeedMode::per_minute && feed_out.value >= kFastestFeed;  // FMAX
        if (step.action == CycleAction::feed && !by_rapid) {
          Feed now = out ? feed_out : feed;
          now.value *= step.share;
          emit(state, column,
               LinearFeed{state.position.target(), state.modes.tool_axis, Coordinates::program,
                          now});
        } else if (!(before == state.position.target())) {
          emit(state, column,
               Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
        }
        depth = step.value;
        break;
      }
      case CycleAction::dwell:
        emit(state, column, Dwell{step.value});
        break;
      case CycleAction::stop_spindle:
        turn(SpindleDirection::off);
        break;
      case CycleAction::start_spindle:
        if (step.value > 0.0) state.modes.spindle_speed = step.value;
        turn(turned);
        break;
      case CycleAction::reverse_spindle:
        if (step.value > 0.0) state.modes.spindle_speed = step.value;
        turn(turned == SpindleDirection::clockwise ? SpindleDirection::counterclockwise
                                                   : SpindleDirection::clockwise);
        break;
      case CycleAction::orient_spindle:
        emit(state, column, Event{"orient_spindle", {}});
        break;
      case CycleAction::wait:
        emit(state, column, Stop{StopKind::program_stop});
        break;
    }
  }
}

void tap_hole(InterpreterState& state, const std::vector<CycleStep>& steps, std::uint32_t column,
              const PlaceInHole& place, const RigidTap& tap) {
  const auto turn = [&](const SpindleChange& to) {
    const bool turns = to.direction != SpindleDirection::off;
    const bool same_speed = !turns || to.speed == state.modes.spindle_speed;
    const bool same = to.direction == state.modes.spindle && same_speed;
    state.modes.spindle = to.direction;
    state.modes.spindle_speed = to.speed;
    if (!same) emit(state, column, to);
  };
  const bool right = tap.lead > 0.0;
  turn({right ? SpindleDirection::clockwise : SpindleDirection::counterclockwise, tap.speed});
  const Feed feed{std::abs(tap.lead), FeedMode::per_revolution, true};
  drill(state, steps, column, place, feed, feed);
  turn(tap.after);
}

}  // namespace frustum::parser

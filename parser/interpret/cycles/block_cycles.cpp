// Canned cycles in a program: their words, which stay in force until the motion changes, and their
// repeats.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxHoles = 99'999;

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

}  // namespace

// Words that the block gives replace those in force.
BlockExecutor::Outcome BlockExecutor::set_cycle(const BlockWords& words, const Movement& movement,
                                                AxisLetter depth_axis) {
  const char depth_letter = to_char(depth_axis);
  const bool goes_on = state_.cycle && is_cycle(state_.cycle->last);
  CannedCycle cycle = goes_on ? *state_.cycle : CannedCycle{};
  if (goes_on && rules_.cycles.words_end_with_their_g_word && cycle.last != movement.motion) {
    cycle = CannedCycle{.initial = cycle.initial};
  }
  if (!goes_on) {
    if (!position_[depth_axis]) {
      return fail(movement.column, position_.unknown_id(depth_axis),
                  fmt::format("the cycle starts at an unknown {}: {}", depth_letter,
                              position_.why_unknown(depth_axis)),
                  fmt::format("program {} in absolute coordinates (G90) before it", depth_letter));
    }
    cycle.initial = *position_[depth_axis];
  }
  cycle.last = movement.motion;
  const auto read = [&](char letter, std::optional<double>& value, double scale) {
    if (words.has(letter)) value = words[letter].value * scale;
  };
  read('R', cycle.level, unit_scale());
  read(depth_letter, cycle.bottom, unit_scale());
  const bool incremental = state_.distance == DistanceMode::incremental;
  const bool any_block = !rules_.cycles.words_keep_their_mode;
  if (any_block || words.has('R')) cycle.level_is_step = incremental;
  if (any_block || words.has(depth_letter)) cycle.bottom_is_step = incremental;
  read('Q', cycle.peck, unit_scale());
  const bool milliseconds =
      rules_.dialect == Dialect::fanuc && words.has('P') && !words['P'].decimal_point;
  read('P', cycle.dwell, milliseconds ? 1.0 / kMillisecondsPerSecond : 1.0);
  const PlaneAxes axes = axes_of(state_.plane);
  read("IJK"[axes.u], cycle.shift_u, unit_scale());
  read("IJK"[axes.v], cycle.shift_v, unit_scale());
  read("IJK"[3 - axes.u - axes.v], cycle.back, unit_scale());

  const auto missing = [&](char letter, std::string what) {
    return fail(movement.column, "cycle-word-missing"_id,
                fmt::format("the cycle has no {}", letter), std::move(what));
  };
  if (!cycle.level) return missing('R', "give R, where feeding begins");
  if (!cycle.bottom) {
    return missing(depth_letter, fmt::format("give {}, the bottom of the hole", depth_letter));
  }
  if (needs_peck(cycle.last) && (!cycle.peck || *cycle.peck <= 0.0)) {
    return missing('Q', "give Q, the depth of a peck, above zero");
  }
  if (rules_.dialect == Dialect::linuxcnc && needs_dwell(cycle.last) && !cycle.dwell) {
    return missing('P', "give P, the dwell at the bottom in seconds");
  }
  if (cycle.dwell.value_or(0.0) < 0.0) return missing('P', "P is a time that is not negative");
  const bool by_q = rules_.cycles.tool_shift_by_q && words_shift_by_q(cycle.last);
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
  state_.cycle = cycle;
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::run_cycle(const BlockWords& words, const Movement& movement) {
  const PlaneAxes axes = axes_of(state_.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const auto w = static_cast<AxisLetter>(3 - axes.u - axes.v);
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  if (state_.programmed_frame.scale != 1.0 ||
      state_.programmed_frame.mirrors.at(static_cast<std::size_t>(w))) {
    return fail(movement.column, "cycle-frame"_id,
                "a canned cycle where the depths are scaled or mirrored",
                fmt::format("end it before, by G50 or G50.1 {}0", to_char(w)));
  }
  if (auto done = set_cycle(words, movement, w); !done) return done;
  const CannedCycle& cycle = *state_.cycle;
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(words[rotary].column, "cycle-rotary"_id,
                fmt::format("{} in a canned cycle", words.text_of(rotary)),
                "turn the axes on the block before");
  }
  const auto feed = feed_for(words, movement, true);
  if (!feed) return feed.error();

  CycleDepths depths;
  depths.level = *cycle.level + (cycle.level_is_step ? cycle.initial : 0.0);
  depths.bottom = *cycle.bottom + (cycle.bottom_is_step ? depths.level : 0.0);
  depths.clear = state_.retract_to_initial ? std::max(cycle.initial, depths.level) : depths.level;
  depths.feed_out = rules_.cycles.feed_out_to_clearance ? depths.clear : depths.level;
  depths.peck = cycle.peck.value_or(0.0);
  depths.dwell = cycle.dwell.value_or(0.0);
  depths.back = cycle.back.value_or(0.0) + (cycle.bottom_is_step ? depths.bottom : 0.0);
  if (needs_peck(cycle.last) && depths.level - depths.bottom > kMostPecks * depths.peck) {
    return fail(movement.column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks), "give a larger Q");
  }
  depths.from_level = rules_.cycles.tool_shift_by_q && cycle.last == MotionMode::bore_back;
  if (depths.from_level) {
    depths.clear = cycle.initial;
    if (depths.bottom <= depths.level || cycle.initial <= depths.bottom) {
      return fail(
          movement.column, "cycle-depth"_id,
          fmt::format("G87 bores from R ({:g} mm) up to {} ({:g} mm), below the tool ({:g} mm)",
                      depths.level, to_char(w), depths.bottom, cycle.initial),
          "give R below the bore, the other depth above R, and start above both");
    }
  } else if (depths.bottom > depths.level) {
    return fail(movement.column, "cycle-depth"_id,
                fmt::format("the bottom of the hole ({:g} mm) lies above R ({:g} mm)",
                            depths.bottom, depths.level),
                "give R above the bottom");
  }
  int holes = 1;
  for (const char letter : {'L', 'K'}) {
    const bool repeats = letter == 'L' || rules_.dialect == Dialect::fanuc;
    if (!repeats || !words.has(letter)) continue;
    const auto given = whole(words, letter, 0, kMaxHoles);
    if (!given) return given.error();
    holes = *given;
  }
  const auto rapid = [&](std::uint32_t column) {
    emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  };
  const double stands = rules_.cycles.start_from_initial ? cycle.initial : *position_[w];
  if (holes > 0 && stands < depths.level) {
    position_.set(w, depths.level);
    rapid(movement.column);
  }
  // With G99 it goes up to a higher R on the way.
  if (rules_.cycles.start_from_initial) {
    position_.set(w,
                  state_.retract_to_initial ? depths.clear : std::max(*position_[w], depths.level));
  }
  for (int hole = 0; hole < holes; ++hole) {
    if (auto done = set_place_in_plane(words); !done) return done;
    for (const AxisLetter axis : {u, v}) {
      if (position_[axis]) continue;
      return fail(
          movement.column, position_.unknown_id(axis),
          fmt::format("the place of the hole is not known: {}", position_.why_unknown(axis)),
          fmt::format("give {} on this block", to_char(axis)));
    }
    rapid(movement.column);
    if (*position_[w] != depths.level && !depths.from_level) {
      position_.set(w, depths.level);
      rapid(movement.column);
    }
    Vec3 centre;
    for (const AxisLetter axis : {u, v, w}) {
      centre[static_cast<Eigen::Index>(axis)] = *position_[axis];
    }
    const auto place = [&](double depth, bool shifted) {
      Vec3 point = centre;
      if (shifted) {
        point[axes.u] += state_.cycle->shift_u.value_or(0.0);
        point[axes.v] += state_.cycle->shift_v.value_or(0.0);
      }
      point[axes.w] = depth;
      return point;
    };
    drill(steps_at_hole(cycle.last, depths), movement.column, place, *feed, *feed);
  }
  return Done{};
}

void BlockExecutor::drill(const std::vector<CycleStep>& steps, std::uint32_t column,
                          const PlaceInHole& place, const Feed& feed, const Feed& feed_out) {
  const SpindleDirection turned = state_.spindle;
  const auto turn = [&](SpindleDirection direction) {
    state_.spindle = direction;
    emit(column, SpindleChange{direction, state_.spindle_speed});
  };
  double depth = std::numeric_limits<double>::infinity();
  for (const CycleStep& step : steps) {
    switch (step.action) {
      case CycleAction::rapid:
      case CycleAction::feed: {
        const AxisTarget before = position_.target();
        const Vec3 point = place(step.value, step.shifted);
        for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
          position_.set(axis, point[static_cast<Eigen::Index>(axis)]);
        }
        if (step.action == CycleAction::feed) {
          Feed now = step.value > depth ? feed_out : feed;
          now.value *= step.share;
          emit(column, LinearFeed{position_.target(), state_.tool_axis, Coordinates::program, now});
        } else if (!(before == position_.target())) {
          emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
        }
        depth = step.value;
        break;
      }
      case CycleAction::dwell:
        emit(column, Dwell{step.value});
        break;
      case CycleAction::stop_spindle:
        turn(SpindleDirection::off);
        break;
      case CycleAction::start_spindle:
        turn(turned);
        break;
      case CycleAction::reverse_spindle:
        if (step.value > 0.0) state_.spindle_speed = step.value;
        turn(turned == SpindleDirection::clockwise ? SpindleDirection::counterclockwise
                                                   : SpindleDirection::clockwise);
        break;
      case CycleAction::orient_spindle:
        emit(column, Event{"orient_spindle", {}});
        break;
      case CycleAction::wait:
        emit(column, Stop{StopKind::program_stop});
        break;
    }
  }
}

}  // namespace frustum::parser

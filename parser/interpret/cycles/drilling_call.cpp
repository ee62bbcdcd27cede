#include "parser/interpret/cycles/drilling_call.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/constants.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/canned_cycle_call.hpp"
#include "parser/interpret/cycles/drilling_steps.hpp"
#include "parser/interpret/cycles/hole_pattern.hpp"
#include "parser/interpret/cycles/tap_words.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMostMode = 1'000'000'000;

// Seconds; below zero, or where the call says so, turns of the spindle.
Result<double> drilling_dwell(const InterpreterState& state, const BlockWords& words, char letter,
                              bool turns) {
  const double value = words[letter].value;
  if (value >= 0.0 && !turns) return value;
  if (state.modes.spindle_speed <= 0.0) {
    return fail(state, words[letter].column, "dwell-without-speed"_id,
                "a dwell in revolutions with no spindle speed", "give a spindle speed before");
  }
  return std::abs(value) * kSecondsPerMinute / state.modes.spindle_speed;
}

// The modes of the call: what its other numbers mean.
Result<int> drilling_modes(const InterpreterState& state, const BlockWords& words) {
  const int w = axes_of(state.modes.plane).w;
  if (words['x'].value != 0.0 && words['x'].value != w + 1) {
    return fail(state, words['x'].column, "cycle-plane"_id,
                fmt::format("{} drills across the plane", words.text_of('x')),
                "choose the plane by G17, G18 or G19 so that the tool is along its normal");
  }
  if (words['g'].value != 0.0) {
    return fail(state, words['g'].column, "not-simulated"_id,
                fmt::format("{} is not simulated", words.text_of('g')),
                "give the depth of the tool's tip, with _GMODE 0");
  }
  for (const char letter : {'h', 'i'}) {
    if (!words.has(letter)) continue;
    if (const auto mode = whole(state, words, letter, 0, kMostMode); !mode) return mode.error();
  }
  const int plane = static_cast<int>(words['h'].value) % 10;
  if (plane != 0 && plane != static_cast<int>(state.modes.plane) + 1) {
    return fail(state, words['h'].column, "cycle-plane"_id,
                fmt::format("{} is another plane than that in force", words.text_of('h')),
                "choose the plane by G17, G18 or G19 before");
  }
  return static_cast<int>(std::round(words['i'].value));
}

bool is_tap_word(const GivenCode& code) {
  const auto word = static_cast<DrillingWord>(code.code->value);
  return word == DrillingWord::tap || word == DrillingWord::floating_tap;
}

// The heights that all of them have.
Result<DrillingCycle> drilling_heights(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const std::string name = code.code->name();
  for (const char letter : {'z', 'V'}) {
    if (words.has(letter)) continue;
    return fail(state, code.column, "cycle-word-missing"_id,
                fmt::format("{} has no {}", name, letter == 'z' ? "RTP" : "RFP"),
                fmt::format("give {}(RTP, RFP, SDIS, DP)", name));
  }
  for (const char letter : {'u', 'd', 'Q', 'm', 'v', 'w'}) {
    if (letter == 'm' && is_tap_word(code)) continue;  // MPIT, whose sign is the thread's hand
    if (!words.has(letter) || words[letter].value >= 0.0) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "distances and times have no sign");
  }
  const auto modes = drilling_modes(state, words);
  if (!modes) return modes.error();
  DrillingCycle cycle;
  const double scale = unit_scale(state);
  cycle.kind = static_cast<DrillingWord>(code.code->value);
  cycle.back = words['z'].value * scale;
  cycle.reference = words['V'].value * scale;
  cycle.level = cycle.reference + words['u'].value * scale;
  const int measure = *modes % 10;
  const bool relative = measure == 1 || (measure == 0 && words['d'].value > 0.0);
  const char depth = relative ? 'd' : 'Z';
  if (!words.has(depth)) {
    return fail(state, code.column, "cycle-word-missing"_id, name + " has no depth",
                "give DP, the coordinate of the bottom, or DPR, how far it is below RFP");
  }
  cycle.bottom = relative ? cycle.reference - words['d'].value * scale : words['Z'].value * scale;
  if (!(cycle.bottom < cycle.reference)) {
    return fail(state, words[depth].column, "cycle-depth"_id,
                fmt::format("the bottom of the hole ({:g} mm) is not below RFP ({:g} mm)",
                            cycle.bottom, cycle.reference),
                "give RFP above the bottom");
  }
  if (cycle.back < cycle.reference) {
    return fail(state, words['z'].column, "cycle-depth"_id,
                fmt::format("RTP ({:g} mm) is below RFP ({:g} mm)", cycle.back, cycle.reference),
                "the tool goes back to RTP by rapid: give it above the part");
  }
  const auto dwell = drilling_dwell(state, words, 'P', *modes / 10 % 10 == 2);
  if (!dwell) return dwell.error();
  cycle.dwell = *dwell;
  return cycle;
}

// _AMODE of CYCLE83, digit by digit from the right: the depth, DTB, DTS, DTD, the first depth, DAM,
// _DIS1, FRF. Those up to the fourth are what drilling_modes() and drilling_dwell() know.
struct PeckModes {
  char first = 'K';           // FDEP, or Q: FDPR
  bool percent = false;       // DAM
  bool feed_percent = false;  // FRF
  bool turns_above = false;   // DTS
  bool turns_below = false;   // _DTD
};
constexpr double kAll = 100.0;  // per cent

Result<PeckModes> peck_modes(const InterpreterState& state, const BlockWords& words) {
  const int mode = static_cast<int>(std::round(words['i'].value));
  const auto digit = [mode](int tens) { return mode / tens % 10; };
  constexpr int kDwellAbove = 100;
  constexpr int kDwellBelow = 1'000;
  constexpr int kFirstDepth = 10'000;
  constexpr int kDegression = 100'000;
  constexpr int kNear = 1'000'000;
  constexpr int kFeed = 10'000'000;
  PeckModes modes;
  const bool relative =
      digit(kFirstDepth) == 1 || (digit(kFirstDepth) == 0 && words['Q'].value > 0.0);
  modes.first = relative ? 'Q' : 'K';
  modes.turns_above = digit(kDwellAbove) == 2;
  modes.turns_below = digit(kDwellBelow) == 2;
  modes.percent = digit(kDegression) == 2;
  modes.feed_percent = digit(kFeed) == 1;
  if (digit(kFirstDepth) > 2 || digit(kDegression) > 2 || digit(kNear) > 1 || digit(kFeed) > 1) {
    return fail(state, words['i'].column, "not-simulated"_id,
                fmt::format("{} is not simulated", words.text_of('i')),
                "known are 0 to 2 in its fifth and sixth digit, 0 and 1 in the two before");
  }
  return modes;
}

Outcome set_pecks(InterpreterState& state, const BlockWords& words, DrillingCycle& cycle) {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const double scale = unit_scale(state);
  const auto modes = peck_modes(state, words);
  if (!modes) return modes.error();
  if (modes->percent || modes->feed_percent) {
    assume(state, words['i'].column, "CYCLE83 _AMODE",
           "2 in the sixth digit of _AMODE makes DAM percents, 1 in the eighth FRF");
  }
  const char first = modes->first;
  cycle.first =
      first == 'Q' ? words['Q'].value * scale : cycle.reference - words['K'].value * scale;
  const double total = cycle.reference - cycle.bottom;
  if (!words.has(first) || !(cycle.first > 0.0) || cycle.first > total) {
    return fail(state, words.has(first) ? words[first].column : code.column, "cycle-depth"_id,
                fmt::format("the first depth of {} is not within the hole", code.code->name()),
                "give FDEP, its coordinate, or FDPR, how far it is below RFP");
  }
  const double amount = words['r'].value;
  cycle.degression = amount > 0.0 ? amount * scale : amount;
  if (modes->percent) cycle.degression = amount == kAll ? 0.0 : -amount / kAll;
  if (amount <= -1.0 || (modes->percent && !(amount > 0.0 && amount <= kAll))) {
    return fail(state, words['r'].column, "out-of-range"_id,
                fmt::format("{} is no factor", words.text_of('r')),
                "DAM is an amount, or below zero a factor down to -1");
  }
  cycle.least = words['m'].value * scale;
  const auto clears = whole(state, words, 'e', 0, 1);
  if (!clears) return clears.error();
  cycle.clears = *clears == 1;
  const auto above = drilling_dwell(state, words, 'W', modes->turns_above);
  if (!above) return above.error();
  cycle.dwell_above = *above;
  cycle.dwell_below = cycle.dwell;
  if (words['t'].value != 0.0) {
    const auto bottom = drilling_dwell(state, words, 't', modes->turns_below);
    if (!bottom) return bottom.error();
    cycle.dwell = *bottom;
  }
  if (words['f'].value != 0.0) {
    cycle.first_feed = words['f'].value / (modes->feed_percent ? kAll : 1.0);
  }
  if (!(cycle.first_feed > 0.0 && cycle.first_feed <= 1.0)) {
    return fail(state, words['f'].column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of('f')),
                "FRF is the share of the feed for the first depth, from 0.001 to 1");
  }
  if (words['v'].value > 0.0) cycle.chip = words['v'].value * scale;
  if (words['w'].value > 0.0) cycle.near = words['w'].value * scale;
  const std::size_t strokes = pecks(cycle).size();
  if (strokes > 1) {
    assume(
        state, code.column, "CYCLE83",
        "the last strokes, and the way back by rapid, are those of the control's cycle V06.02.09");
  }
  if (strokes > 0) return Done{};
  return fail(state, code.column, "cycle-pecks"_id,
              fmt::format("the cycle makes more than {} pecks", kMostPecks),
              "give a larger first depth, or an amount of degression (DAM)");
}

Result<std::optional<SpindleDirection>> drilling_direction(const InterpreterState& state,
                                                           const BlockWords& words) {
  if (words['e'].value == 0.0) return std::optional<SpindleDirection>{};
  const auto word = whole(state, words, 'e', 3, 5);
  if (!word) return word.error();
  constexpr std::array kDirections{SpindleDirection::clockwise, SpindleDirection::counterclockwise,
                                   SpindleDirection::off};
  return std::optional(kDirections.at(static_cast<std::size_t>(*word - 3)));
}

Result<DrillingCycle> drilling_cycle_of(InterpreterState& state, const BlockWords& words) {
  auto cycle = drilling_heights(state, words);
  if (!cycle) return cycle;
  const double scale = unit_scale(state);
  switch (cycle->kind) {
    case DrillingWord::peck:
      if (auto done = set_pecks(state, words, *cycle); !done) return std::move(done).error();
      return cycle;
    case DrillingWord::tap:
      if (auto done = set_tap(state, words, *cycle); !done) return std::move(done).error();
      if (cycle->first > 0.0) {
        assume(state, words['t'].column, "CYCLE84",
               "its strokes are those of the control's cycle V06.02.09");
      }
      break;
    case DrillingWord::floating_tap:
      if (auto done = set_floating_tap(state, words, *cycle); !done) return std::move(done).error();
      if (words['s'].value == 0.0) return cycle;
      break;
    case DrillingWord::ream:
      for (const char letter : {'f', 'r'}) {
        if (words[letter].value < 0.0) {
          return fail(state, words[letter].column, "value-negative"_id,
                      fmt::format("{} is negative", words.text_of(letter)),
                      "give a feed above zero");
        }
        if (words[letter].value > 0.0) {
          (letter == 'f' ? cycle->feed : cycle->feed_out) = words[letter].value * scale;
        }
      }
      return cycle;
    default:
      break;
  }
  for (const char letter : {'I', 'J', 'K'}) {
    cycle->retract[letter - 'I'] = words[letter].value * scale;
  }
  const auto direction = drilling_direction(state, words);
  if (!direction) return direction.error();
  cycle->direction = *direction;
  return cycle;
}

bool is_tap(const DrillingCycle& cycle) {
  return cycle.kind == DrillingWord::tap || cycle.kind == DrillingWord::floating_tap;
}

// A tap in a floating chuck turns as the spindle does at the hole.
Outcome take_spindle(const InterpreterState& state, std::uint32_t column, DrillingCycle& cycle) {
  if (cycle.kind != DrillingWord::floating_tap) return Done{};
  if (state.modes.spindle == SpindleDirection::off || !(state.modes.spindle_speed > 0.0)) {
    return fail(state, column, "thread-spindle-off"_id, "CYCLE840 while the spindle is at rest",
                "start the spindle with S and M3 or M4 before");
  }
  if (cycle.direction_back == state.modes.spindle) {
    return fail(state, column, "cycle-direction"_id,
                "CYCLE840 comes back as the spindle turns on the way in (SDR)",
                "give SDR against M3 or M4 before the cycle, or 0");
  }
  cycle.speed = cycle.speed_back = state.modes.spindle_speed;
  if (!cycle.direction) cycle.direction = state.modes.spindle;
  if (cycle.by_spindle && state.modes.spindle == SpindleDirection::counterclockwise) {
    cycle.lead = -cycle.lead;
  }
  if (!cycle.by_spindle && cycle.lead > 0.0) {
    cycle.feed = cycle.feed_out = cycle.lead * state.modes.spindle_speed;
  }
  return Done{};
}

// The cycle gives the spindle the speed of before it again; without one that of the tap stays.
double speed_after_hole(InterpreterState& state, const DrillingCycle& cycle, std::uint32_t column) {
  const double before = state.modes.spindle_speed;
  if (before > 0.0 || cycle.kind != DrillingWord::tap) return before;
  if (cycle.direction.value_or(SpindleDirection::off) != SpindleDirection::off) {
    assume(state, column, "CYCLE84 S",
           "no S is given before the cycle: the spindle turns on with the speed of the way back");
  }
  return cycle.speed_back;
}

Outcome drill_here(InterpreterState& state, DrillingCycle cycle, std::uint32_t column) {
  if (cycle.fault) return *cycle.fault;
  if (auto done = take_spindle(state, column, cycle); !done) return done;
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto w = static_cast<AxisLetter>(axes.w);
  const Movement movement{NonModal::none, MotionMode::linear, column};
  for (const int slot : {axes.u, axes.v}) {
    const auto axis = static_cast<AxisLetter>(slot);
    if (state.position[axis]) continue;
    return fail(
        state, column, state.position.unknown_id(axis),
        fmt::format("the place of the hole is not known: {}", state.position.why_unknown(axis)),
        "move to the hole before");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (state.modes.tool_axis) {
    return fail(state, column, "cycle-tool-vector"_id, "a cycle with a tool vector",
                "tilt the plane by CYCLE800 before");
  }
  if (state.modes.programmed_frame.scale != 1.0 ||
      state.modes.programmed_frame.mirrors.at(static_cast<std::size_t>(w))) {
    return fail(state, column, "cycle-frame"_id, "a cycle where the depths are scaled or mirrored",
                "end that before, by SCALE or MIRROR alone");
  }
  const bool own_feeds = cycle.by_spindle || (cycle.feed && cycle.feed_out);
  if (!own_feeds && state.modes.feed_mode == FeedMode::inverse_time) {
    return fail(state, column, "cycle-inverse-time"_id, "a cycle in G93",
                "give the feed per minute, in G94");
  }
  const bool of_control =
      state.control.feed_before_first_word && !state.modes.feed_was_given && !own_feeds;
  if (of_control) {
    assume(state, column, "feed", "a cycle before the first F: the control has a feed of its own");
  } else if (!own_feeds && !state.modes.feed) {
    return fail(state, column, "feed-missing"_id, "a cycle without a feed rate",
                "give F before, above zero");
  }
  const double given = state.modes.feed ? state.modes.feed->scaled : 0.0;
  const auto feed_by = [&](const std::optional<double>& own) {
    const bool lead = is_tap(cycle) && own;
    return Feed{own.value_or(given), lead ? FeedMode::per_minute : state.modes.feed_mode};
  };
  const auto turn = [&](SpindleDirection direction, double speed) {
    state.modes.spindle = direction;
    state.modes.spindle_speed = speed;
    emit(state, column, SpindleChange{direction, speed});
  };
  const double speed_after = speed_after_hole(state, cycle, column);
  state.position.set(w, cycle.level);
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  emit(state, column,
       Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  if (!is_tap(cycle) && cycle.direction && *cycle.direction != state.modes.spindle) {
    turn(*cycle.direction, state.modes.spindle_speed);
  }
  Vec3 hole = Vec3::Zero();
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    hole[static_cast<Eigen::Index>(axis)] = *state.position[axis];
  }
  const auto place = [&](double depth, bool shifted) {
    Vec3 point = hole;
    if (shifted) {
      point[axes.u] += cycle.retract.x();
      point[axes.v] += cycle.retract.y();
    }
    point[axes.w] = depth;
    return point;
  };
  const SpindleChange after{cycle.direction.value_or(SpindleDirection::off), speed_after};
  if (cycle.by_spindle) {
    tap_hole(state, steps_of(cycle), column, place, {cycle.lead, cycle.speed, after});
    return Done{};
  }
  drill(state, steps_of(cycle), column, place, feed_by(cycle.feed), feed_by(cycle.feed_out));
  if (is_tap(cycle)) turn(after.direction, after.speed);
  return Done{};
}

// HOLES1, HOLES2, CYCLE801: the modal cycle at each place; without one the tool only goes there.
Outcome drill_pattern(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_pattern];
  const auto places = pattern_places(state, words);
  if (!places) return places.error();
  const PlaneAxes axes = axes_of(state.modes.plane);
  for (const Vec2& place : *places) {
    state.position.set(static_cast<AxisLetter>(axes.u), place.x());
    state.position.set(static_cast<AxisLetter>(axes.v), place.y());
    emit(state, code.column,
         Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
    if (!state.modes.drilling) continue;
    const DrillingCycle cycle = *state.modes.drilling;
    if (auto done = drill_here(state, cycle, code.column); !done) return done;
  }
  return Done{};
}

}  // namespace

Outcome call_drilling_cycle(InterpreterState& state, const BlockWords& words) {
  if (words.has(CodeGroup::hole_pattern)) return drill_pattern(state, words);
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const bool modal = words.has(CodeGroup::hole_call);
  if (code.code == nullptr) {
    if (modal) state.modes.drilling.reset();
    if (!state.modes.drilling || !state.at_work.moved) return Done{};
    const DrillingCycle cycle = *state.modes.drilling;
    return drill_here(state, cycle, 1);
  }
  const auto cycle = drilling_cycle_of(state, words);
  if (!cycle && !modal) return cycle.error();
  if (!modal) return drill_here(state, *cycle, code.column);
  state.modes.drilling = cycle ? *cycle : DrillingCycle{};
  if (!cycle) state.modes.drilling->fault = cycle.error().front();
  return Done{};
}

}  // namespace frustum::parser

#include "parser/interpret/cycles/hole_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/canned_cycle_call.hpp"
#include "parser/interpret/cycles/cycle_parameters.hpp"
#include "parser/interpret/cycles/deep_hole.hpp"
#include "parser/interpret/cycles/point_pattern.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxBreaks = 99'999;

constexpr double kSameDepth =
    1e-9;  // mm, rounding: what is left below a step is no step of its own

MotionMode kind_of(HoleWord word, bool dwells) {
  switch (word) {
    case HoleWord::peck:
      return MotionMode::peck;
    case HoleWord::break_chip:
      return MotionMode::peck_short;
    case HoleWord::tap:
      return MotionMode::tap;
    case HoleWord::bore_oriented:
      return MotionMode::fine_bore;
    case HoleWord::bore:
      return dwells ? MotionMode::bore_dwell : MotionMode::bore;
    default:
      return dwells ? MotionMode::drill_dwell : MotionMode::drill;
  }
}

// Of the pecking of older controls: how far above the last depth the tool stops coming back.
double stop_above(double depth) {
  constexpr double kShallowDepth = 30.0;
  constexpr double kOfShallowDepth = 0.6;
  constexpr double kShareOfDepth = 1.0 / 50.0;
  constexpr double kMostAbove = 7.0;
  return depth <= kShallowDepth ? kOfShallowDepth : std::min(depth * kShareOfDepth, kMostAbove);
}

// 202: off the wall, back by the feed out, and over the centre again.
std::vector<CycleStep> steps_of_oriented_bore(const CycleDepths& depths) {
  using enum CycleAction;
  std::vector<CycleStep> steps{{feed, depths.bottom}};
  if (depths.dwell > 0.0) steps.push_back({dwell, depths.dwell});
  steps.push_back({stop_spindle});
  steps.push_back({orient_spindle});
  steps.push_back({feed, depths.bottom, true});
  steps.push_back({feed, depths.level, true});
  if (depths.clear > depths.level) steps.push_back({rapid, depths.clear, true});
  steps.push_back({rapid, std::max(depths.clear, depths.level)});
  steps.push_back({start_spindle});
  return steps;
}

// 209: the tool turns back at each step, by so much or out of the hole.
std::vector<CycleStep> steps_of_tap(const CycleDepths& depths, double step, double back) {
  using enum CycleAction;
  std::vector<CycleStep> steps;
  for (int n = 1; depths.bottom + n * step < -kSameDepth; ++n) {
    steps.push_back({feed, -n * step});
    steps.push_back({reverse_spindle});
    steps.push_back({feed, back > 0.0 ? std::min(back - n * step, depths.level) : depths.level});
    steps.push_back({start_spindle});
  }
  steps.push_back({feed, depths.bottom});
  steps.push_back({reverse_spindle});
  steps.push_back({feed, depths.level});
  steps.push_back({rapid, depths.clear});
  return steps;
}

Outcome set_tap_steps(InterpreterState& state, const BlockWords& words) {
  for (const char letter : {'E', 'H'}) {
    if (words[letter].value >= 0.0) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "the steps of a tap have no sign");
  }
  HoleCycle& cycle = state.modes.hole_cycle;
  cycle.tap_step = length_of(state, words['E'].value);
  cycle.tap_back = words['H'].value * std::abs(cycle.lead.value_or(0.0));
  if (cycle.tap_step > 0.0 && cycle.depth > kMostPecks * cycle.tap_step) {
    return fail(state, words['E'].column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  return Done{};
}

// What the manuals that could be had leave open.
struct AssumedCycle {
  std::string_view cycle;
  std::string_view text;
};
constexpr std::string_view kSpindleAfterTap =
    "the spindle turns afterwards as it did before the cycle";
constexpr std::array kAssumedCycles{
    AssumedCycle{
        "CYCL DEF 203",
        "the tool breaks the chip Q213 times by Q256 before it clears the hole by the feed "
        "Q208, and comes back by rapid to Q200 above the last depth"},
    AssumedCycle{"CYCL DEF 205",
                 "pecks shrink by Q212 down to Q205, and the stop above the last depth goes evenly "
                 "from Q258 to Q259"},
    AssumedCycle{"CYCL DEF 207", kSpindleAfterTap},
    AssumedCycle{"CYCL DEF 206", "the tap comes back by the feed that it went in with"},
    AssumedCycle{"CYCL DEF 209",
                 "at each Q257 the tap goes back by Q256 times the pitch, or out of the hole where "
                 "that is 0; the spindle turns afterwards as it did before the cycle"},
    AssumedCycle{
        "CYCL DEF 241",
        "it goes from Q200 to the depth in one stroke by Q206 and back by Q208; the speeds "
        "of the spindle on the way are not simulated"},
    AssumedCycle{"CYCL DEF 240", "it drills to Q201 in one stroke and leaves by rapid"}};

void tell_assumed_cycle(InterpreterState& state, const GivenCode& code) {
  const auto* known = std::ranges::find(kAssumedCycles, code.code->word, &AssumedCycle::cycle);
  if (known != kAssumedCycles.end()) assume(state, code.column, known->cycle, known->text);
}

// Q239, and PITCH of 17: the hand of the thread by its sign.
Outcome set_pitch(InterpreterState& state, const BlockWords& words) {
  const double pitch = words['r'].value;
  if (pitch == 0.0) {
    return fail(state, words['r'].column, "cycle-lead"_id, "the pitch of the thread is zero",
                "give it above zero, or below for a left-handed thread");
  }
  state.modes.hole_cycle.lead = pitch * feed_scale(state, FeedMode::per_revolution);
  return Done{};
}

// The feed of a word: a number, that of the tool call (AUTO), by rapid (MAX).
Result<Feed> feed_of(const InterpreterState& state, const BlockWords& words, char letter,
                     FeedMode mode) {
  const GivenWord& word = words[letter];
  if (word.source == ValueSource::fastest) return Feed{kFastestFeed, FeedMode::per_minute};
  if (word.source == ValueSource::number) {
    const Feed feed{word.value * feed_scale(state, mode), mode};
    if (feed.value >= 0.0) return feed;
    return fail(state, word.column, "feed-not-positive"_id,
                fmt::format("the feed {} is below zero", words.text_of(letter)),
                "give a feed above zero");
  }
  if (state.modes.tool_feed) return Feed{state.modes.tool_feed->scaled, FeedMode::per_minute};
  return fail(state, word.column, "tool-feed-missing"_id,
              words.name_of(letter) + "=AUTO without a feed in the tool call",
              "give F in TOOL CALL, or a number here");
}

// Of Klartext, which has heights and steps without a sign.
Outcome check_lengths(const InterpreterState& state, const BlockWords& words) {
  for (const char letter : {'u', 'v', 'Q', 'o'}) {
    if (words[letter].value >= 0.0) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "clearances and steps have no sign");
  }
  return Done{};
}

// The words of 1, 2 and 17 come one a block; the first begins anew.
Outcome set_old_cycle(InterpreterState& state, const BlockWords& words, HoleWord word) {
  HoleCycle& cycle = state.modes.hole_cycle;
  const double scale = unit_scale(state);
  if (words.has('u')) {
    cycle = {};
    cycle.on = cycle.of_tool = true;
    cycle.clear = cycle.level = std::abs(words['u'].value) * scale;
  }
  cycle.kind = word == HoleWord::old_peck ? MotionMode::peck : MotionMode::tap;
  if (words.has('z')) {
    if (words['z'].value >= 0.0) {
      return fail(state, words['z'].column, "cycle-depth"_id,
                  fmt::format("the depth {:g} is not below zero", words['z'].value),
                  "the depth counts from the surface, downwards: DEPTH -20");
    }
    cycle.depth = -words['z'].value * scale;
  }
  if (words.has('Q')) cycle.peck = std::abs(words['Q'].value) * scale;
  if (words.has('P')) cycle.dwell = words['P'].value;
  if (words['P'].value < 0.0) {
    return fail(state, words['P'].column, "value-negative"_id,
                fmt::format("the dwell {:g} is negative", words['P'].value),
                "a dwell takes a time that is not negative");
  }
  if (words.has('r')) {
    assume(state, words['r'].column, "CYCL DEF 17", kSpindleAfterTap);
    return set_pitch(state, words);
  }
  if (!words.has('f')) return Done{};
  cycle.feed = {words['f'].value * feed_scale(state, FeedMode::per_minute), FeedMode::per_minute};
  if (cycle.feed.value > 0.0) return Done{};
  return fail(state, words['f'].column, "feed-not-positive"_id,
              "the feed of the cycle is not above zero", "give a feed above zero");
}

Outcome set_deep_hole(InterpreterState& state, const BlockWords& words, HoleWord word) {
  for (const char letter : std::string_view("QDLHEghx")) {
    if (words[letter].value >= 0.0) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "lengths of a peck count downwards without a sign");
  }
  HoleCycle& cycle = state.modes.hole_cycle;
  const auto length = [&](char letter, double otherwise) {
    return words.has(letter) ? length_of(state, words[letter].value) : otherwise;
  };
  DeepHole hole;
  hole.depth = cycle.depth;
  hole.first = length('Q', 0.0);
  hole.decrement = length('D', 0.0);
  hole.least = length('L', 0.0);
  if (words.has('x')) hole.others = length('x', 0.0);
  hole.chip = length('H', hole.chip);
  hole.break_each = length('E', 0.0);
  hole.dwell = cycle.dwell;
  hole.dwell_above = cycle.dwell_above;
  const bool in_pecks = word == HoleWord::deep_pecks;
  hole.first_stop = in_pecks ? length('g', 0.2) : cycle.clear;
  hole.last_stop = in_pecks ? length('h', hole.first_stop) : cycle.clear;
  hole.clears_by_feed = !in_pecks;
  hole.leaves_by_feed = !in_pecks || words.has('W');
  if (words.has('K')) {
    const auto breaks = whole(state, words, 'K', 0, kMaxBreaks);
    if (!breaks) return breaks.error();
    hole.breaks = *breaks;
  }
  const double pecks = peck_count(hole);
  if (!std::isfinite(pecks)) {
    return fail(state, words['D'].column, "cycle-pecks"_id,
                "the pecks shrink to nothing above the bottom", "give the least one: Q205=1");
  }
  if (pecks > kMostPecks) {
    return fail(state, words[words.has('E') ? 'E' : 'Q'].column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  cycle.deep = hole;
  return Done{};
}

}  // namespace

std::optional<Vec3> point_of_hole(const AxisTarget& target) {
  Vec3 point;
  for (const AxisLetter axis : kLinearAxes) {
    if (!target[axis]) return std::nullopt;
    point[static_cast<Eigen::Index>(axis)] = *target[axis];
  }
  return point;
}

void drill_from_top(InterpreterState& state, const Vec3& top, const std::optional<Vec3>& from,
                    bool turns, std::uint32_t column) {
  const HoleCycle& cycle = state.modes.hole_cycle;
  const Vec3 axis = state.modes.tool_axis ? state.modes.tool_axis->vec() : Vec3::UnitZ();
  const auto place = [&](double height, bool shifted) -> Vec3 {
    return top + height * axis + (shifted ? cycle.off_wall : Vec3::Zero());
  };
  // The tool has not gone to the top.
  bool must_move = !from || turns;
  if (from) {
    for (const AxisLetter letter : kLinearAxes) {
      state.position.set(letter, (*from)[static_cast<Eigen::Index>(letter)]);
    }
  }
  const auto rapid_to = [&](const Vec3& point) {
    const AxisTarget before = state.position.target();
    for (const AxisLetter letter : kLinearAxes) {
      state.position.set(letter, point[static_cast<Eigen::Index>(letter)]);
    }
    if (before == state.position.target() && !must_move) return;
    must_move = false;
    emit(state, column,
         Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  };
  // Where the height is not known the tool comes over the hole as high as it is.
  if (!from && !state.modes.tool_axis) {
    AxisTarget over = state.position.target();
    const bool stands =
        !over[AxisLetter::Z] && over[AxisLetter::X] == top.x() && over[AxisLetter::Y] == top.y();
    over[AxisLetter::X] = top.x();
    over[AxisLetter::Y] = top.y();
    over[AxisLetter::Z].reset();
    if (!stands) emit(state, column, Traverse{over, std::nullopt, Coordinates::program});
  }
  const double height = from && !turns ? (*from - top).dot(axis) : cycle.clear;
  if (from && height < cycle.clear) {
    // Up first, so that the way to the hole is clear.
    rapid_to(*from + (cycle.clear - height) * axis);
  }
  rapid_to(place(std::max(height, cycle.clear), false));
  rapid_to(place(cycle.clear, false));
  rapid_to(place(cycle.level, false));

  CycleDepths depths;
  depths.level = cycle.level;
  depths.bottom = -cycle.depth;
  depths.clear = cycle.back.value_or(cycle.clear);
  if (cycle.back_to_start && cycle.start) {
    depths.clear = std::max((*cycle.start - top).dot(axis), cycle.clear);
  }
  depths.feed_out = depths.level;
  depths.rigid = cycle.lead.has_value();
  depths.peck = cycle.peck;
  depths.dwell = cycle.dwell;
  depths.peck_from = cycle.level;
  if (cycle.top) {
    depths.chip = cycle.clear;
    depths.peck_from = 0.0;
    depths.dwell_above = cycle.dwell_above;
  }
  if (cycle.of_tool) {
    depths.chip = stop_above(cycle.depth);
    depths.peck_from = 0.0;
  }
  std::vector<CycleStep> steps =
      cycle.deep ? steps_at_deep_hole(*cycle.deep, cycle.level, depths.clear)
      : cycle.kind == MotionMode::fine_bore ? steps_of_oriented_bore(depths)
      : cycle.tap_step > 0.0                ? steps_of_tap(depths, cycle.tap_step, cycle.tap_back)
                                            : steps_at_hole(cycle.kind, depths);
  if (!cycle.lead) {
    drill(state, steps, column, place, cycle.feed, cycle.feed_out.value_or(cycle.feed));
    return;
  }
  const double speed = state.modes.spindle_speed;
  const bool left =
      cycle.hand_of_spindle && state.modes.spindle == SpindleDirection::counterclockwise;
  tap_hole(state, steps, column, place,
           {left ? -*cycle.lead : *cycle.lead, speed, {state.modes.spindle, speed}});
}

Outcome set_hole_cycle(InterpreterState& state, const BlockWords& words) {
  if (!state.at_work.block->pattern.empty()) return set_point_pattern(state, words);
  if (words[CodeGroup::hole_cycle].code == nullptr) return Done{};
  if (auto done = define_hole_cycle(state, words); !done) {
    state.modes.hole_cycle = {};  // nothing half defined is called
    return done;
  }
  if (state.modes.hole_cycle.top) set_cycle_parameters(state, words, true);
  return Done{};
}

Outcome define_hole_cycle(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_cycle];
  HoleCycle& cycle = state.modes.hole_cycle;
  const auto word = static_cast<HoleWord>(code.code->value);
  cycle.start.reset();
  if (word == HoleWord::off || word == HoleWord::on) {
    cycle.on = word == HoleWord::on;
    if (!cycle.on || cycle.kind != MotionMode::none) return Done{};
    return fail(state, code.column, "cycle-missing"_id, "there is no cycle to switch on",
                "define one before");
  }
  if (word == HoleWord::old_peck || word == HoleWord::old_tap) {
    return set_old_cycle(state, words, word);
  }
  const double scale = unit_scale(state);
  cycle = {};
  const bool from_surface = words.has('V');
  const double depth = from_surface ? -words['z'].value : words['Z'].value;
  const bool pecks = from_surface && words['Q'].value > 0.0 && words['Q'].value < depth;
  if (pecks && word == HoleWord::bore) {
    return fail(state, words['Q'].column, "not-simulated"_id,
                fmt::format("{} of {} is not simulated", words.text_of('Q'), code.code->name()),
                "give the whole depth, or leave it out");
  }
  cycle.kind = kind_of(pecks ? HoleWord::peck : word, words['P'].value > 0.0);
  cycle.on = true;
  cycle.depth = depth * scale;
  cycle.level = words[from_surface ? 'u' : 'R'].value * scale;
  cycle.clear = words['u'].value * scale;
  if (words.has('v')) cycle.back = words['v'].value * scale;
  cycle.back_to_start = words.has('I');
  cycle.peck = words['Q'].value * scale;
  cycle.dwell = words['P'].value;
  const char feed = words.has('r') ? 'r' : 'f';
  const FeedMode mode = feed == 'r' ? FeedMode::per_revolution : FeedMode::per_minute;
  if (from_surface && feed == 'r') {
    if (auto done = set_pitch(state, words); !done) return done;
  } else if (words.has('t')) {
    cycle.lead = words['t'].value * feed_scale(state, FeedMode::per_revolution);
    cycle.hand_of_spindle = true;
    if (*cycle.lead <= 0.0) {
      return fail(state, words['t'].column, "cycle-lead"_id,
                  "the lead of the tap is not above zero",
                  "give it above zero; the direction of the spindle says the hand of the thread");
    }
  } else {
    const auto given = feed_of(state, words, feed, mode);
    if (!given) return given.error();
    cycle.feed = *given;
  }
  if (from_surface) {
    if (auto done = check_lengths(state, words); !done) return done;
    cycle.top = words['V'].value * scale;
    cycle.dwell_above = words['w'].value;
    cycle.back = std::max(cycle.back.value_or(0.0), cycle.clear);
    if (words.has('W')) {
      const auto out = feed_of(state, words, 'W', mode);
      if (!out) return out.error();
      if (out->value > 0.0) cycle.feed_out = *out;
    }
    if (depth <= 0.0) {
      return fail(state, words['z'].column, "cycle-depth"_id,
                  fmt::format("{} is not below zero", words.text_of('z')),
                  "the depth counts from the surface, downwards: Q201=-20");
    }
  }
  if (!cycle.lead && cycle.feed.value <= 0.0) {
    return fail(state, words[feed].column, "feed-not-positive"_id,
                "the feed of the cycle is not above zero", "give a feed above zero");
  }
  for (const char letter : {'P', 'w'}) {
    if (words[letter].value >= 0.0) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "a dwell takes a time that is not negative");
  }
  if (cycle.back && *cycle.back < cycle.level) {
    return fail(state, words['v'].column, "cycle-depth"_id,
                fmt::format("{} is below where feeding begins", words.text_of('v')),
                "give a height above it");
  }
  if (word == HoleWord::bore_oriented) {
    constexpr double kOffWall = 0.2;  // mm
    constexpr int kLastDirection = 4;
    const auto direction = whole(state, words, 'n', 0, kLastDirection);
    if (!direction) return direction.error();
    const std::array kDirections{Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(1, 0, 0),
                                 Vec3(0, 1, 0)};
    cycle.off_wall = kDirections.at(static_cast<std::size_t>(*direction)) *
                     (words.has('o') ? words['o'].value * scale : kOffWall);
    return Done{};
  }
  if (from_surface) tell_assumed_cycle(state, code);
  if (word == HoleWord::deep || word == HoleWord::deep_pecks)
    return set_deep_hole(state, words, word);
  if (from_surface && word == HoleWord::tap) return set_tap_steps(state, words);
  const bool steps = cycle.kind == MotionMode::peck || cycle.kind == MotionMode::peck_short;
  if (steps && cycle.level + cycle.depth > kMostPecks * cycle.peck) {
    return fail(state, words['Q'].column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  return Done{};
}

void set_called_program(InterpreterState& state, std::string name) {
  state.modes.hole_cycle = {};
  state.modes.hole_cycle.program = std::move(name);
}

}  // namespace frustum::parser

// Hole cycles in a program: their definition, and one hole.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxBreaks = 99'999;
constexpr double kSameAxis = 1e-9;  // the sine of the angle between two tool axes

MotionMode kind_of(HoleWord word, bool dwells) {
  switch (word) {
    case HoleWord::peck:
      return MotionMode::peck;
    case HoleWord::break_chip:
      return MotionMode::peck_short;
    case HoleWord::tap:
      return MotionMode::tap;
    case HoleWord::bore:
      return dwells ? MotionMode::bore_dwell : MotionMode::bore;
    default:
      return dwells ? MotionMode::drill_dwell : MotionMode::drill;
  }
}

std::optional<Vec3> point_of_hole(const AxisTarget& target) {
  Vec3 point;
  for (const AxisLetter axis : kLinearAxes) {
    if (!target[axis]) return std::nullopt;
    point[static_cast<Eigen::Index>(axis)] = *target[axis];
  }
  return point;
}

}  // namespace

BlockExecutor::Outcome BlockExecutor::set_hole_cycle(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_cycle];
  if (code.code == nullptr) return Done{};
  HoleCycle& cycle = state_.hole_cycle;
  const auto word = static_cast<HoleWord>(code.code->value);
  cycle.start.reset();
  if (word == HoleWord::off || word == HoleWord::on) {
    cycle.on = word == HoleWord::on;
    if (!cycle.on || cycle.kind != MotionMode::none) return Done{};
    return fail(code.column, "cycle-missing"_id, "there is no cycle to switch on",
                "define one before");
  }
  const double scale = unit_scale();
  cycle = {};
  const bool from_surface = words.has('V');
  const double depth = from_surface ? -words['z'].value : words['Z'].value;
  const bool pecks = from_surface && words['Q'].value > 0.0 && words['Q'].value < depth;
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
  cycle.feed = {words[feed].value * feed_scale(mode), mode};
  if (from_surface) {
    cycle.top = words['V'].value * scale;
    cycle.dwell_above = words['w'].value;
    cycle.back = std::max(cycle.back.value_or(0.0), cycle.clear);
    if (words['W'].value > 0.0) cycle.feed_out = Feed{words['W'].value * feed_scale(mode), mode};
    if (depth <= 0.0) {
      return fail(words['z'].column, "cycle-depth"_id,
                  fmt::format("{} is not below zero", words.text_of('z')),
                  "the depth counts from the surface, downwards: Q201=-20");
    }
    if (cycle.clear < 0.0) {
      return fail(words['u'].column, "value-negative"_id,
                  fmt::format("{} is negative", words.text_of('u')),
                  "give the set-up clearance above the surface");
    }
  }
  if (cycle.feed.value <= 0.0) {
    return fail(words[feed].column, "feed-not-positive"_id,
                "the feed of the cycle is not above zero", "give a feed above zero");
  }
  for (const char letter : {'P', 'w'}) {
    if (words[letter].value >= 0.0) continue;
    return fail(words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "a dwell takes a time that is not negative");
  }
  if (cycle.back && *cycle.back < cycle.level) {
    return fail(words['v'].column, "cycle-depth"_id,
                fmt::format("{} lies below where feeding begins", words.text_of('v')),
                "give a height above it");
  }
  if (word == HoleWord::deep || word == HoleWord::deep_pecks) return set_deep_hole(words, word);
  const bool steps = cycle.kind == MotionMode::peck || cycle.kind == MotionMode::peck_short;
  if (steps && cycle.level + cycle.depth > kMostPecks * cycle.peck) {
    return fail(words['Q'].column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_deep_hole(const BlockWords& words, HoleWord word) {
  for (const char letter : std::string_view("QDLHEgh")) {
    if (words[letter].value >= 0.0) continue;
    return fail(words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "lengths of a peck count downwards without a sign");
  }
  HoleCycle& cycle = state_.hole_cycle;
  const auto length = [&](char letter, double otherwise) {
    return words.has(letter) ? words[letter].value * unit_scale() : otherwise;
  };
  DeepHole hole;
  hole.depth = cycle.depth;
  hole.first = length('Q', 0.0);
  hole.decrement = length('D', 0.0);
  hole.least = length('L', 0.0);
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
    const auto breaks = whole(words, 'K', 0, kMaxBreaks);
    if (!breaks) return breaks.error();
    hole.breaks = *breaks;
  }
  const double pecks = peck_count(hole);
  if (!std::isfinite(pecks)) {
    return fail(words['D'].column, "cycle-pecks"_id, "the pecks shrink to nothing above the bottom",
                "give the least one: Q205=1");
  }
  if (pecks > kMostPecks) {
    return fail(words[words.has('E') ? 'E' : 'Q'].column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  cycle.deep = hole;
  return Done{};
}

void BlockExecutor::set_called_program(std::string name) {
  state_.hole_cycle = {};
  state_.hole_cycle.program = std::move(name);
}

// The words name the top of the hole; the tool comes from where it is, over the hole and down.
BlockExecutor::Outcome BlockExecutor::make_hole(const BlockWords& words, const Movement& movement) {
  HoleCycle& cycle = state_.hole_cycle;
  if (movement.motion != MotionMode::linear && movement.motion != MotionMode::traverse) {
    return fail(movement.column, "cycle-arc"_id, "an arc while a cycle is on",
                "end the cycle before, by CYCLE/OFF");
  }
  for (const char letter : {'X', 'Y', 'Z'}) {
    if (!words.has(letter) || words[letter].measure != Measure::incremental) continue;
    return fail(words[letter].column, "cycle-step"_id, "a step while a cycle is on",
                "name the hole by its place");
  }
  const auto from = point_of_hole(position_.target());
  const auto axis_before = state_.tool_axis;
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = set_targets(words); !done) return done;
  if (auto done = set_tool_axis(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  const auto top = point_of_hole(position_.target());
  if (!top)
    return fail(movement.column, "position-unknown"_id, "the place of the hole is not known",
                "give X, Y and Z");
  const Vec3 axis = state_.tool_axis ? state_.tool_axis->vec() : Vec3::UnitZ();
  const bool turns = axis_before.has_value() != state_.tool_axis.has_value() ||
                     (axis_before && axis_before->vec().cross(axis).norm() > kSameAxis);
  if (!cycle.start) cycle.start = from;
  drill_from_top(*top, from, turns, movement.column);
  return Done{};
}

// From where the tool is, over the hole and down. After a turn of the tool its place says nothing
// about heights.
void BlockExecutor::drill_from_top(const Vec3& top, const std::optional<Vec3>& from, bool turns,
                                   std::uint32_t column) {
  const HoleCycle& cycle = state_.hole_cycle;
  const Vec3 axis = state_.tool_axis ? state_.tool_axis->vec() : Vec3::UnitZ();
  const auto place = [&](double height, bool /*shifted*/) -> Vec3 { return top + height * axis; };
  // The tool has not gone to the top.
  bool must_move = !from || turns;
  if (from) {
    for (const AxisLetter letter : kLinearAxes) {
      position_.set(letter, (*from)[static_cast<Eigen::Index>(letter)]);
    }
  }
  const auto rapid_to = [&](const Vec3& point) {
    const AxisTarget before = position_.target();
    for (const AxisLetter letter : kLinearAxes) {
      position_.set(letter, point[static_cast<Eigen::Index>(letter)]);
    }
    if (before == position_.target() && !must_move) return;
    must_move = false;
    emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  };
  const double stands = from && !turns ? (*from - top).dot(axis) : cycle.clear;
  if (from && stands < cycle.clear) {
    // Up first, so that the way to the hole is clear.
    rapid_to(*from + (cycle.clear - stands) * axis);
  }
  rapid_to(place(std::max(stands, cycle.clear), false));
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
  depths.peck = cycle.peck;
  depths.dwell = cycle.dwell;
  depths.peck_from = cycle.level;
  if (cycle.top) {
    depths.chip = cycle.clear;
    depths.peck_from = 0.0;
    depths.dwell_above = cycle.dwell_above;
  }
  drill(cycle.deep ? steps_at_deep_hole(*cycle.deep, cycle.level, depths.clear)
                   : steps_at_hole(cycle.kind, depths),
        column, place, cycle.feed, cycle.feed_out.value_or(cycle.feed));
}

// CYCL CALL, M99: at the place where the tool is.
BlockExecutor::Outcome BlockExecutor::call_hole_cycle(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_call];
  if (code.code == nullptr || !state_.hole_cycle.program.empty()) return Done{};
  if (!state_.hole_cycle.on) {
    return fail(code.column, "cycle-missing"_id, code.code->name() + " without a cycle",
                "define it before, for example by CYCL DEF 200");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
    if (position_[axis]) continue;
    return fail(code.column, position_.unknown_id(axis),
                fmt::format("the place of the hole is not known: {}", position_.why_unknown(axis)),
                "move to the hole before");
  }
  const Movement movement{NonModal::none, MotionMode::linear, code.column};
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  if (state_.programmed_frame.scale != 1.0 || state_.programmed_frame.mirrors[2]) {
    return fail(code.column, "cycle-frame"_id, "a cycle where the depths are scaled or mirrored",
                "end that before, by CYCL DEF 11.1 SCL 1 or CYCL DEF 8.1");
  }
  if (state_.tool_axis) {
    return fail(code.column, "cycle-tool-vector"_id, "a cycle with a tool vector",
                "tilt the plane by PLANE before");
  }
  const Vec3 top(*position_[AxisLetter::X], *position_[AxisLetter::Y], *state_.hole_cycle.top);
  drill_from_top(top, point_of_hole(position_.target()), false, code.column);
  return Done{};
}

}  // namespace frustum::parser

// Drilling cycles at the place where the tool is, called once or, by MCALL, after each block that
// moves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/cycles/drilling_cycle.hpp"

namespace frustum::parser {
namespace {

constexpr int kMostMode = 1'000'000'000;

}  // namespace

// Seconds; below zero, or where the call says so, turns of the spindle.
Result<double> BlockExecutor::drilling_dwell(const BlockWords& words, char letter,
                                             bool turns) const {
  const double value = words[letter].value;
  if (value >= 0.0 && !turns) return value;
  if (state_.spindle_speed <= 0.0) {
    return fail(words[letter].column, "dwell-without-speed"_id,
                "a dwell in revolutions with no spindle speed", "give a spindle speed before");
  }
  return std::abs(value) * kSecondsPerMinute / state_.spindle_speed;
}

// The modes of the call: what its other numbers mean.
Result<int> BlockExecutor::drilling_modes(const BlockWords& words) const {
  const int w = axes_of(state_.plane).w;
  if (words['x'].value != 0.0 && words['x'].value != w + 1) {
    return fail(words['x'].column, "cycle-plane"_id,
                fmt::format("{} drills across the plane", words.text_of('x')),
                "choose the plane by G17, G18 or G19 so that the tool is along its normal");
  }
  if (words['g'].value != 0.0) {
    return fail(words['g'].column, "not-simulated"_id,
                fmt::format("{} is not simulated", words.text_of('g')),
                "give the depth of the tool's tip, with _GMODE 0");
  }
  for (const char letter : {'h', 'i'}) {
    if (!words.has(letter)) continue;
    if (const auto mode = whole(words, letter, 0, kMostMode); !mode) return mode.error();
  }
  const int plane = static_cast<int>(words['h'].value) % 10;
  if (plane != 0 && plane != static_cast<int>(state_.plane) + 1) {
    return fail(words['h'].column, "cycle-plane"_id,
                fmt::format("{} is another plane than that in force", words.text_of('h')),
                "choose the plane by G17, G18 or G19 before");
  }
  return static_cast<int>(std::round(words['i'].value));
}

// The heights that all of them have.
Result<DrillingCycle> BlockExecutor::drilling_heights(const BlockWords& words) const {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const std::string name = code.code->name();
  for (const char letter : {'z', 'V'}) {
    if (words.has(letter)) continue;
    return fail(code.column, "cycle-word-missing"_id,
                fmt::format("{} has no {}", name, letter == 'z' ? "RTP" : "RFP"),
                fmt::format("give {}(RTP, RFP, SDIS, DP)", name));
  }
  for (const char letter : {'u', 'd', 'Q', 'W'}) {
    if (!words.has(letter) || words[letter].value >= 0.0) continue;
    return fail(words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "distances and times have no sign");
  }
  const auto modes = drilling_modes(words);
  if (!modes) return modes.error();
  DrillingCycle cycle;
  const double scale = unit_scale();
  cycle.kind = static_cast<DrillingWord>(code.code->value);
  cycle.back = words['z'].value * scale;
  cycle.reference = words['V'].value * scale;
  cycle.level = cycle.reference + words['u'].value * scale;
  const int measure = *modes % 10;
  const bool relative = measure == 1 || (measure == 0 && words['d'].value > 0.0);
  const char depth = relative ? 'd' : 'Z';
  if (!words.has(depth)) {
    return fail(code.column, "cycle-word-missing"_id, name + " has no depth",
                "give DP, the coordinate of the bottom, or DPR, how far it is below RFP");
  }
  cycle.bottom = relative ? cycle.reference - words['d'].value * scale : words['Z'].value * scale;
  if (!(cycle.bottom < cycle.reference)) {
    return fail(words[depth].column, "cycle-depth"_id,
                fmt::format("the bottom of the hole ({:g} mm) is not below RFP ({:g} mm)",
                            cycle.bottom, cycle.reference),
                "give RFP above the bottom");
  }
  if (cycle.back < cycle.reference) {
    return fail(words['z'].column, "cycle-depth"_id,
                fmt::format("RTP ({:g} mm) lies below RFP ({:g} mm)", cycle.back, cycle.reference),
                "the tool goes back to RTP by rapid: give it above the part");
  }
  const auto dwell = drilling_dwell(words, 'P', *modes / 10 % 10 == 2);
  if (!dwell) return dwell.error();
  cycle.dwell = *dwell;
  return cycle;
}

BlockExecutor::Outcome BlockExecutor::set_pecks(const BlockWords& words,
                                                DrillingCycle& cycle) const {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const double scale = unit_scale();
  const char first = words['Q'].value > 0.0 ? 'Q' : 'K';
  cycle.first =
      first == 'Q' ? words['Q'].value * scale : cycle.reference - words['K'].value * scale;
  const double total = cycle.reference - cycle.bottom;
  if (!words.has(first) || !(cycle.first > 0.0) || cycle.first > total) {
    return fail(words.has(first) ? words[first].column : code.column, "cycle-depth"_id,
                fmt::format("the first depth of {} is not within the hole", code.code->name()),
                "give FDEP, its coordinate, or FDPR, how far it is below RFP");
  }
  const double amount = words['r'].value;
  cycle.degression = amount > 0.0 ? amount * scale : amount;
  if (amount <= -1.0) {
    return fail(words['r'].column, "out-of-range"_id,
                fmt::format("{} is no factor", words.text_of('r')),
                "DAM is an amount, or below zero a factor down to -1");
  }
  cycle.least = words['m'].value * scale;
  const auto clears = whole(words, 'e', 0, 1);
  if (!clears) return clears.error();
  cycle.clears = *clears == 1;
  cycle.dwell_above = words['W'].value;
  cycle.dwell_below = cycle.dwell;
  if (words['t'].value != 0.0) {
    const auto bottom = drilling_dwell(words, 't', false);
    if (!bottom) return bottom.error();
    cycle.dwell = *bottom;
  }
  if (words['f'].value != 0.0) cycle.first_feed = words['f'].value;
  if (!(cycle.first_feed > 0.0 && cycle.first_feed <= 1.0)) {
    return fail(words['f'].column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of('f')),
                "FRF is the share of the feed for the first depth, from 0.001 to 1");
  }
  if (words['v'].value > 0.0) cycle.chip = words['v'].value * scale;
  if (words['w'].value > 0.0) cycle.near = words['w'].value * scale;
  if (!pecks(cycle).empty()) return Done{};
  return fail(code.column, "cycle-pecks"_id,
              fmt::format("the cycle makes more than {} pecks", kMostPecks),
              "give a larger first depth, or an amount of degression (DAM)");
}

Result<std::optional<SpindleDirection>> BlockExecutor::drilling_direction(
    const BlockWords& words) const {
  if (words['e'].value == 0.0) return std::optional<SpindleDirection>{};
  const auto word = whole(words, 'e', 3, 5);
  if (!word) return word.error();
  constexpr std::array kDirections{SpindleDirection::clockwise, SpindleDirection::counterclockwise,
                                   SpindleDirection::off};
  return std::optional(kDirections.at(static_cast<std::size_t>(*word - 3)));
}

BlockExecutor::Outcome BlockExecutor::set_tap(const BlockWords& words, DrillingCycle& cycle) const {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const bool by_size = words['m'].value != 0.0;
  const auto metric =
      by_size ? metric_lead(words['m'].value) : std::optional(words['k'].value * unit_scale());
  if (!metric) {
    return fail(words['m'].column, "cycle-lead"_id,
                fmt::format("{} is no metric thread", words.text_of('m')),
                "give M3 to M48 by its number, or the lead by PIT");
  }
  if (*metric == 0.0) {
    return fail(code.column, "cycle-lead"_id, code.code->name() + " has no lead",
                "give MPIT, the size of a metric thread, or PIT, its lead");
  }
  cycle.lead = *metric;
  cycle.speed = words['s'].value;
  cycle.speed_back = words['l'].value != 0.0 ? words['l'].value : cycle.speed;
  if (!(cycle.speed > 0.0 && cycle.speed_back > 0.0)) {
    return fail(words.has('s') ? words['s'].column : code.column, "cycle-speed-missing"_id,
                code.code->name() + " has no spindle speed", "give SST, in revolutions per minute");
  }
  return Done{};
}

Result<DrillingCycle> BlockExecutor::drilling_cycle_of(const BlockWords& words) const {
  auto cycle = drilling_heights(words);
  if (!cycle) return cycle;
  const double scale = unit_scale();
  switch (cycle->kind) {
    case DrillingWord::peck:
      if (auto done = set_pecks(words, *cycle); !done) return std::move(done).error();
      return cycle;
    case DrillingWord::tap:
      if (auto done = set_tap(words, *cycle); !done) return std::move(done).error();
      break;
    case DrillingWord::ream:
      for (const char letter : {'f', 'r'}) {
        if (words[letter].value < 0.0) {
          return fail(words[letter].column, "value-negative"_id,
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
  const auto direction = drilling_direction(words);
  if (!direction) return direction.error();
  cycle->direction = *direction;
  return cycle;
}

// A block that has a cycle defines it, or makes the hole; with MCALL it is in force until MCALL
// alone.
BlockExecutor::Outcome BlockExecutor::call_drilling_cycle(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::drilling_cycle];
  const bool modal = words.has(CodeGroup::hole_call);
  if (code.code == nullptr) {
    if (modal) state_.drilling.reset();
    if (!state_.drilling || !moved_) return Done{};
    const DrillingCycle cycle = *state_.drilling;
    return drill_here(cycle, 1);
  }
  const auto cycle = drilling_cycle_of(words);
  if (!cycle) return cycle.error();
  if (!modal) return drill_here(*cycle, code.column);
  state_.drilling = *cycle;
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::drill_here(const DrillingCycle& cycle, std::uint32_t column) {
  const PlaneAxes axes = axes_of(state_.plane);
  const auto w = static_cast<AxisLetter>(axes.w);
  const Movement movement{NonModal::none, MotionMode::linear, column};
  for (const int slot : {axes.u, axes.v}) {
    const auto axis = static_cast<AxisLetter>(slot);
    if (position_[axis]) continue;
    return fail(column, position_.unknown_id(axis),
                fmt::format("the place of the hole is not known: {}", position_.why_unknown(axis)),
                "move to the hole before");
  }
  if (auto done = check_tool_length(movement); !done) return done;
  if (state_.tool_axis) {
    return fail(column, "cycle-tool-vector"_id, "a cycle with a tool vector",
                "tilt the plane by CYCLE800 before");
  }
  if (state_.programmed_frame.scale != 1.0 ||
      state_.programmed_frame.mirrors.at(static_cast<std::size_t>(w))) {
    return fail(column, "cycle-frame"_id, "a cycle where the depths are scaled or mirrored",
                "end that before, by SCALE or MIRROR alone");
  }
  const bool own_feeds = cycle.kind == DrillingWord::tap || (cycle.feed && cycle.feed_out);
  if (!own_feeds && state_.feed_mode == FeedMode::inverse_time) {
    return fail(column, "cycle-inverse-time"_id, "a cycle in G93",
                "give the feed per minute, in G94");
  }
  if (!own_feeds && !state_.feed) {
    return fail(column, "feed-missing"_id, "a cycle without a feed rate",
                "give F before, above zero");
  }
  const double given = state_.feed ? state_.feed->scaled : 0.0;
  Feed feed{cycle.feed.value_or(given), state_.feed_mode};
  Feed feed_out{cycle.feed_out.value_or(given), state_.feed_mode};
  const auto turn = [&](SpindleDirection direction, double speed) {
    state_.spindle = direction;
    state_.spindle_speed = speed;
    emit(column, SpindleChange{direction, speed});
  };
  if (cycle.kind == DrillingWord::tap) {
    feed = feed_out = {std::abs(cycle.lead), FeedMode::per_revolution, true};
  }
  const double speed_before = state_.spindle_speed;
  position_.set(w, cycle.level);
  if (auto done = check_programmed_frame(movement); !done) return done;
  emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  if (cycle.kind == DrillingWord::tap) {
    turn(cycle.lead > 0.0 ? SpindleDirection::clockwise : SpindleDirection::counterclockwise,
         cycle.speed);
  } else if (cycle.direction && *cycle.direction != state_.spindle) {
    turn(*cycle.direction, state_.spindle_speed);
  }
  Vec3 hole = Vec3::Zero();
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    hole[static_cast<Eigen::Index>(axis)] = *position_[axis];
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
  drill(steps_of(cycle), column, place, feed, feed_out);
  if (cycle.kind == DrillingWord::tap) {
    turn(cycle.direction.value_or(SpindleDirection::off), speed_before);
  }
  return Done{};
}

}  // namespace frustum::parser

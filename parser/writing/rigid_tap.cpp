#include "parser/writing/rigid_tap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parser/writing/number_text.hpp"

namespace frustum::parser {
namespace {

bool moves(const Motion& motion) {
  return std::holds_alternative<LinearFeed>(motion.command) ||
         std::holds_alternative<Traverse>(motion.command) ||
         std::holds_alternative<ArcFeed>(motion.command) ||
         std::holds_alternative<Probe>(motion.command) ||
         std::holds_alternative<HomeReturn>(motion.command);
}

// Feeds and places that a length of the tool was added to and taken from differ by rounding.
bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(a)); }

// Before the tool cuts again the program says how the spindle turns.
bool spindle_is_set(std::span<const Motion> rest) {
  for (const Motion& motion : rest) {
    if (std::holds_alternative<SpindleChange>(motion.command)) return true;
    if (std::holds_alternative<ToolChange>(motion.command)) return true;
    if (moves(motion) && !std::holds_alternative<Traverse>(motion.command) &&
        !std::holds_alternative<HomeReturn>(motion.command)) {
      return false;
    }
  }
  return true;
}

}  // namespace

RigidTapMotions rigid_tap_of(const LinearFeed& in, const SpindleChange& turning,
                             const AxisTarget& start, std::span<const Motion> rest) {
  RigidTapMotions tap;
  SpindleChange back = turning;
  bool dwells = false;
  std::size_t i = 0;
  for (; i < rest.size() && !moves(rest[i]); ++i) {
    if (const auto* spindle = std::get_if<SpindleChange>(&rest[i].command)) back = *spindle;
    if (const auto* dwell = std::get_if<Dwell>(&rest[i].command)) {
      dwells = dwells || dwell->seconds > 0.0;
    }
  }
  tap.reverses = back.direction != turning.direction && back.direction != SpindleDirection::off;
  if (!tap.reverses) return tap;
  const auto* out = i < rest.size() ? std::get_if<LinearFeed>(&rest[i].command) : nullptr;
  if (out == nullptr || !out->feed.synchronised || !same(out->feed.value, in.feed.value)) {
    tap.obstacle = "a tap that does not come back by its lead";
    return tap;
  }
  const bool to_start = std::ranges::all_of(kAxisLetters, [&](AxisLetter letter) {
    const auto& here = out->end[letter];
    const auto& there = start[letter] ? start[letter] : in.end[letter];
    return here.has_value() == there.has_value() && (!here || same(*here, *there));
  });
  if (!to_start) {
    tap.obstacle = "a tap that does not come back to where it began";
  } else if (back.speed != turning.speed) {
    tap.obstacle = "a tap that comes back at another speed of the spindle";
  } else if (dwells) {
    tap.obstacle = "a tap that dwells at the bottom";
  }
  tap.after = i + 1;
  if (!spindle_is_set(rest.subspan(tap.after))) tap.left = back;
  return tap;
}

TapStrokes tap_strokes_of(const LinearFeed& in, const SpindleChange& turning,
                          const AxisTarget& start, std::span<const Motion> rest) {
  TapStrokes tap;
  AxisTarget at = start;
  SpindleChange now = turning;
  double dwell = 0.0;
  const auto stay = [&at](const LinearFeed& move) {
    return std::ranges::all_of(kAxisLetters, [&](AxisLetter letter) {
      const auto& end = move.end[letter];
      return letter == AxisLetter::Z || !end || (at[letter] && same(*at[letter], *end));
    });
  };
  // False where the move is no stroke of the tap.
  const auto add = [&](const LinearFeed& move) {
    const auto& from = at[AxisLetter::Z];
    const auto& to = move.end[AxisLetter::Z];
    if (!from || !to || !stay(move) || move.coordinates != Coordinates::program) return false;
    const bool out = *to > *from;
    const bool right = (now.direction == SpindleDirection::clockwise) != out;
    if (tap.strokes.empty()) tap.right_handed = right;
    const bool turns = now.direction != SpindleDirection::off && now.speed > 0.0;
    if (!turns || right != tap.right_handed || !same(move.feed.value, in.feed.value)) return false;
    // A stroke that goes on is one.
    const bool goes_on = !tap.strokes.empty() && tap.strokes.back().out == out && dwell == 0.0 &&
                         tap.strokes.back().speed == now.speed;
    if (goes_on) tap.strokes.pop_back();
    tap.strokes.push_back({*to, now.speed, out, goes_on ? 0.0 : dwell});
    at = move.end;
    dwell = 0.0;
    return true;
  };
  tap.obstacle = "a tap whose strokes are not along Z by one lead";
  if (!add(in)) return tap;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (const auto* spindle = std::get_if<SpindleChange>(&rest[i].command)) now = *spindle;
    if (const auto* wait = std::get_if<Dwell>(&rest[i].command)) dwell += wait->seconds;
    if (!moves(rest[i])) continue;
    const auto* move = std::get_if<LinearFeed>(&rest[i].command);
    if (move == nullptr || !move->feed.synchronised) break;
    if (!add(*move)) return tap;
    tap.after = i + 1;
  }
  tap.obstacle = {};
  const auto& last = tap.strokes.back();
  const bool clockwise = tap.right_handed != last.out;
  if (!spindle_is_set(rest.subspan(tap.after))) {
    tap.left = SpindleChange{
        clockwise ? SpindleDirection::clockwise : SpindleDirection::counterclockwise, last.speed};
  }
  return tap;
}

std::string strokes_text(const TapStrokes& tap, const Feed& feed, double speed,
                         const NcSpelling& spelling, const MotionWords& words, int feed_digits) {
  std::string text(spelling.before_strokes);
  const std::string lead = significant(feed.value, feed_digits);
  const auto number = [&](double value) { return significant(value, feed_digits); };
  for (const TapStroke& stroke : tap.strokes) {
    if (stroke.dwell_before > 0.0) {
      text += "\n" + filled(spelling.dwell, '#', number(stroke.dwell_before));
    }
    text += "\n" + fmt::format(fmt::runtime(spelling.tap_strokes.at(stroke.out ? 1 : 0)),
                               fmt::arg("z", words.text_of(AxisLetter::Z, stroke.z)),
                               fmt::arg("signed", (tap.right_handed ? "" : "-") + lead));
    if (stroke.speed == speed) continue;
    speed = stroke.speed;
    text += " " + filled(spelling.speed, '#', number(speed));
  }
  return text;
}

std::string_view obstacle_to_cycle(const MotionWords& words, const LinearFeed& move, bool guided) {
  const AxisTarget start = words.at();
  bool alone = start[AxisLetter::Z].has_value();
  for (const AxisLetter letter : kAxisLetters) {
    if (letter == AxisLetter::Z || !move.end[letter]) continue;
    alone = alone && start[letter] &&
            words.text_of(letter, *start[letter]) == words.text_of(letter, *move.end[letter]);
  }
  if (!alone || move.coordinates == Coordinates::machine) return "a tap that is not along Z";
  if (!(*move.end[AxisLetter::Z] < *start[AxisLetter::Z])) return "a tap upwards";
  if (move.tool_axis || guided) return "a tap with tool centre point control";
  return {};
}

}  // namespace frustum::parser

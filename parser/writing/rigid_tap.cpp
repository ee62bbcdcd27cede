#include "parser/writing/rigid_tap.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace frustum::parser

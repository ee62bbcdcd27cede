#include "lint/cutting_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/units.hpp"

namespace frustum::lint {
namespace {

using parser::Dialect;
using parser::FeedMode;
using parser::LengthCompensation;
using parser::SpindleDirection;

constexpr double kMmPerInch = 25.4;

std::string_view length_words(Dialect dialect) {
  switch (dialect) {
    case Dialect::sinumerik:
      return "give D1 with the tool change";
    case Dialect::heidenhain:
    case Dialect::cldata:
      return "call the tool again after its length was switched off";
    default:
      return "give G43 H and the tool's number after the tool change";
  }
}

}  // namespace

std::string offset_name(int number, Dialect dialect) {
  const int tool = number % parser::kEdgeOffsets, edge = number / parser::kEdgeOffsets + 1;
  if (dialect != Dialect::sinumerik || edge == 1) return fmt::format("tool {}", number);
  return fmt::format("edge {} of tool {}", edge, tool);
}

void check_spindle(const CuttingMove& move, const MotionState& state, FindingList& findings) {
  const bool stands = state.modes.spindle.direction == SpindleDirection::off;
  const bool no_speed = !(state.modes.spindle.speed > 0.0) && !state.surface_speed;
  if (!stands && !no_speed) return;
  findings.raise(Check::spindle_off, state.spindle_changes, move.place, [&] {
    return stands ? Words{.message = "cutting move with the spindle off",
                          .hint = "start it by S and M3 (or M4) before the cut",
                          .alike = "off"}
                  : Words{.message = "cutting move with the spindle on at no speed",
                          .hint = "give S with M3 or before it",
                          .alike = "no speed"};
  });
}

void check_tool(const CuttingMove& move, const MotionState& state, Dialect dialect,
                FindingList& findings) {
  if (!state.modes.tool) {
    findings.raise(Check::tool_missing, 0, move.place, [] {
      return Words{
          .message = "cutting move before any tool is called",
          .hint =
              "call the tool, so that the program does not cut with what happens to be in the "
              "spindle",
          .alike = "no tool"};
    });
    return;
  }
  if (*state.modes.tool == 0 || state.modes.compensation.mode != LengthCompensation::off) return;
  findings.raise(Check::length_missing, state.compensation_changes, move.place, [&] {
    return Words{.message = fmt::format("tool {} cuts without its length being compensated",
                                        *state.modes.tool),
                 .hint = std::string(length_words(dialect)),
                 .alike = fmt::format("T{}", *state.modes.tool)};
  });
}

void check_length_number(const parser::Motion& motion, const MotionState& state, Dialect dialect,
                         FindingList& findings) {
  const auto* change = std::get_if<parser::CompensationChange>(&motion.command);
  if (change == nullptr || change->mode == LengthCompensation::off) return;
  if (!state.modes.tool || change->offset_number == 0) return;
  const int tool = *state.modes.tool;
  const bool edges = dialect == Dialect::sinumerik;
  if (change->offset_number == tool) return;
  if (edges && (change->offset_number - tool) % parser::kEdgeOffsets == 0) return;
  findings.raise(Check::length_of_other_tool, FindingList::key_of(motion.place), motion.place, [&] {
    return Words{fmt::format("the length of {} is put in force, and tool {} is in the spindle",
                             offset_name(change->offset_number, dialect), tool),
                 edges ? fmt::format("D1 after the change to tool {} is meant?", tool)
                       : fmt::format("H{} is meant?", tool)};
  });
}

void check_feed(const CuttingMove& move, FindingList& findings) {
  const double feed = move.feed.value;
  if (move.feed.mode == FeedMode::inverse_time) {
    if (!move.length) return;
    const double speed = *move.length * feed;
    if (speed <= kHighFeed) return;
    findings.raise(Check::inverse_time_speed, FindingList::key_of(move.place), move.place, [&] {
      return Words{fmt::format("{:.4g} mm in a {:g}th of a minute are {:.0f} mm/min", *move.length,
                               feed, speed),
                   "F is the inverse of the block's minutes in G93; was G94 meant?"};
    });
    return;
  }
  if (move.feed.mode == FeedMode::per_revolution) {
    if (feed <= kHighFeedPerTurn) return;
    findings.raise(Check::feed_high, FindingList::key_of(feed), move.place, [&] {
      return Words{.message = fmt::format("feed of {:g} mm per revolution", feed),
                   .hint = "G95 is in force; was G94 meant?",
                   .alike = fmt::format("{:g} mm per revolution", feed)};
    });
    return;
  }
  // A move of rotary axes alone has its feed in degrees.
  if (!move.linear) return;
  if (feed > kHighFeed) {
    findings.raise(Check::feed_high, FindingList::key_of(feed), move.place, [&] {
      return Words{.message = fmt::format("feed of {:g} mm/min", feed),
                   .hint = "is the unit of lengths (G20, G21) the one that F is written in?",
                   .alike = fmt::format("{:g}", feed)};
    });
  } else if (feed < kLowFeed) {
    findings.raise(Check::feed_low, FindingList::key_of(feed), move.place, [&] {
      return Words{.message = fmt::format("feed of {:g} mm/min", feed),
                   .hint = fmt::format("were {:g} inches a minute meant (G20, or F{:g})?", feed,
                                       feed * kMmPerInch),
                   .alike = fmt::format("{:g}", feed)};
    });
  }
}

void ShortSegments::see(const CuttingMove& move) {
  if (move.arc != nullptr || move.rotary || !move.linear) return;
  if (!move.length || *move.length >= kShortSegment) return;
  if (count_++ == 0) first_ = move.place;
  lines_.insert(move.place);
  shortest_ = std::min(shortest_, *move.length);
}

void ShortSegments::finish(FindingList& findings) const {
  if (count_ == 0) return;
  findings.raise(Check::short_segments, 0, first_, [&] {
    return Words{
        .message = fmt::format("{} cutting {} shorter than {} mm, the shortest {:.2g} mm", count_,
                               count_ == 1 ? "move is" : "moves are", kShortSegment, shortest_),
        .hint = "a controller slows down for such moves; filter points in the CAM system",
        .alike = "short",
        .places = lines_.size()};
  });
}

}  // namespace frustum::lint

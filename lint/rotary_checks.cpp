#include "lint/rotary_checks.hpp"

#include <fmt/format.h>

#include <string_view>

namespace frustum::lint {
namespace {

using parser::AxisTarget;
using parser::Dialect;

std::string_view tip_control_words(Dialect dialect) {
  switch (dialect) {
    case Dialect::fanuc:
      return "G43.4 H";
    case Dialect::linuxcnc:
      return "M428";
    case Dialect::sinumerik:
      return "TRAORI";
    case Dialect::heidenhain:
      return "M128 or FUNCTION TCPM";
    case Dialect::cldata:
      return "MULTAX/ON";
  }
  return "";
}

const AxisTarget* target_of(const parser::Motion& motion) {
  if (const auto* rapid = std::get_if<parser::Traverse>(&motion.command)) {
    return rapid->coordinates == parser::Coordinates::program ? &rapid->end : nullptr;
  }
  if (const auto* line = std::get_if<parser::LinearFeed>(&motion.command)) {
    return line->coordinates == parser::Coordinates::program ? &line->end : nullptr;
  }
  return nullptr;
}

}  // namespace

void check_tip_control(const CuttingMove& move, const MotionState& state, Dialect dialect,
                       FindingList& findings) {
  if (!move.linear || !move.rotary || state.modes.tip_control()) return;
  const auto linear = moving_axis(move.start, move.end, false);
  const auto rotary = moving_axis(move.start, move.end, true);
  if (!linear || !rotary) return;
  const bool by_time = move.feed.mode == parser::FeedMode::inverse_time;
  findings.raise(
      Check::tip_control_off, state.compensation_changes, move.place,
      [&] {
        return Words{fmt::format("{} and {} cut together with the tool centre point control off",
                                 to_char(*linear), to_char(*rotary)),
                     fmt::format("switch it on by {}, unless the words are positions of the axes "
                                 "for this very machine and tool",
                                 tip_control_words(dialect))};
      },
      by_time ? std::optional(Severity::note) : std::nullopt);
}

void check_rotary_with_length(const parser::Motion& motion, const MotionState& state,
                              Dialect dialect, FindingList& findings) {
  if (state.modes.compensation.mode != parser::LengthCompensation::length ||
      state.modes.plane.has_value())
    return;
  const AxisTarget* target = target_of(motion);
  if (target == nullptr) return;
  const auto rotary = moving_axis(state.position, *target, true);
  if (!rotary || linear_axis_moves(state.position, *target)) return;
  findings.raise(Check::rotary_with_length, state.compensation_changes, motion.place, [&] {
    return Words{fmt::format("{} turns with a tool length in force and the tool centre point "
                             "control off: the tip does not stay where it is on the part",
                             to_char(*rotary)),
                 fmt::format("switch it on by {}, or give the work offset of the new position",
                             tip_control_words(dialect))};
  });
}

}  // namespace frustum::lint

#include "lint/end_checks.hpp"

#include <array>
#include <cstdint>

namespace frustum::lint {
namespace {

using parser::Dialect;
using parser::ModalState;

// Controls whose M30 puts things right itself, by their manuals.
enum class Resets : std::uint8_t { none, linuxcnc, linuxcnc_and_heidenhain };

bool puts_right(Dialect dialect, Resets reset) {
  if (dialect == Dialect::linuxcnc) return reset != Resets::none;
  return dialect == Dialect::heidenhain && reset == Resets::linuxcnc_and_heidenhain;
}

struct EndRule {
  Check check;
  bool (*broken)(const MotionState& state, const ModalState& modes);
  const char* message;
  const char* hint;
  Resets reset = Resets::none;
};

constexpr std::array kRules{
    EndRule{Check::no_program_end,
            [](const MotionState& state, const ModalState&) { return !state.ended; },
            "the program ends without M30 or M2", "end it with M30"},
    EndRule{Check::end_tip_control,
            [](const MotionState& state, const ModalState&) { return state.modes.tip_control(); },
            "the program ends with the tool centre point control on",
            "switch it off before the end: G49, M429, TRAFOOF, M129"},
    EndRule{Check::end_incremental,
            [](const MotionState&, const ModalState& modes) {
              return modes.distance == parser::DistanceMode::incremental;
            },
            "the program ends in G91", "give G90 before the end", Resets::linuxcnc},
    EndRule{Check::end_inverse_time,
            [](const MotionState&, const ModalState& modes) {
              return modes.feed_mode == parser::FeedMode::inverse_time;
            },
            "the program ends in G93", "give G94 before the end", Resets::linuxcnc},
    EndRule{
        Check::end_tilted_plane,
        [](const MotionState& state, const ModalState&) { return state.modes.plane.has_value(); },
        "the program ends in a tilted plane",
        "cancel it before the end: G69, CYCLE800(), PLANE RESET"},
    EndRule{Check::end_shifted_frame,
            [](const MotionState&, const ModalState& modes) {
              return !modes.programmed_frame.is_identity();
            },
            "the program ends with a shift or turn of its coordinates in force",
            "cancel it before the end: G69, G52 X0 Y0 Z0, G92.1, TRANS"},
    EndRule{Check::end_spindle,
            [](const MotionState& state, const ModalState&) {
              return state.modes.spindle.direction != parser::SpindleDirection::off;
            },
            "the program ends with the spindle on",
            "give M5 before the end; not every control stops it at M30",
            Resets::linuxcnc_and_heidenhain},
    EndRule{Check::end_coolant,
            [](const MotionState&, const ModalState& modes) { return modes.flood; },
            "the program ends with the coolant on", "give M9 before the end",
            Resets::linuxcnc_and_heidenhain},
};

}  // namespace

void check_end(const MotionState& state, const ModalState& modes, Dialect dialect,
               FindingList& findings) {
  for (const EndRule& rule : kRules) {
    if (state.ended && puts_right(dialect, rule.reset)) continue;
    if (!rule.broken(state, modes)) continue;
    findings.raise(rule.check, 0, state.place, [&] { return Words{rule.message, rule.hint}; });
  }
  if (!state.cuts || state.retracted) return;
  findings.raise(Check::end_no_retract, 0, state.last_cut, [] {
    return Words{"the last cut of the program, and no retract after it",
                 "lift the tool off by a rapid or home move before the end"};
  });
}

}  // namespace frustum::lint

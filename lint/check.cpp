#include "lint/check.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/spelling.hpp"

namespace frustum::lint {
namespace {

using enum Check;
constexpr auto kError = Severity::error;
constexpr auto kWarning = Severity::warning;
constexpr auto kNote = Severity::note;

constexpr std::array kChecks{
    CheckInfo{program_error, "program-error", kError, "A block cannot be read or run"},
    CheckInfo{missing_subprogram, "missing-subprogram", kError, "A call finds no subprogram"},
    CheckInfo{missing_label, "missing-label", kError, "A jump or repeat finds no label"},
    CheckInfo{recursion, "recursion", kError, "Subprograms call each other without end"},
    CheckInfo{endless_loop, "endless-loop", kError, "A loop does not come to its end"},
    CheckInfo{too_many_errors, "too-many-errors", kError,
              "So many blocks cannot be run that the checks end"},
    CheckInfo{unused_subprogram, "unused-subprogram", kWarning, "Nothing calls a subprogram"},
    CheckInfo{unused_label, "unused-label", kNote, "Nothing names a label"},
    CheckInfo{unreachable_code, "unreachable-code", kWarning,
              "Blocks after the end of the program or subprogram never run"},
    CheckInfo{duplicate_number, "duplicate-number", kWarning,
              "A block number that is jumped to is on several blocks"},
    CheckInfo{no_program_end, "no-program-end", kWarning, "The program ends without M30 or M2"},
    CheckInfo{parameter_unset, "parameter-unset", kWarning,
              "A parameter is read before the program sets it"},
    CheckInfo{vacant_word, "vacant-word", kNote,
              "A word is left out since its parameter is vacant"},
    CheckInfo{not_simulated, "not-simulated", kNote, "A word is known and not simulated"},
    CheckInfo{builder_word, "builder-word", kWarning,
              "A word of the machine's builder is passed over"},
    CheckInfo{assumed, "assumed", kWarning,
              "The program depends on what a control decides by its parameters"},
    CheckInfo{decimal_point, "decimal-point", kWarning,
              "A length has no decimal point, which controls read in two ways"},
    CheckInfo{feed_missing, "feed-missing", kError, "A cutting move has no feed"},
    CheckInfo{feed_high, "feed-high", kWarning, "A feed is higher than any cut's"},
    CheckInfo{feed_low, "feed-low", kWarning, "A feed is lower than any cut's"},
    CheckInfo{inverse_time_speed, "inverse-time-speed", kWarning,
              "In inverse time (G93) a move is faster than any cut"},
    CheckInfo{spindle_off, "spindle-off", kError, "A cutting move is made with the spindle off"},
    CheckInfo{spindle_hand, "spindle-hand", kWarning,
              "A tool cuts while the spindle turns against its hand", Needs::job},
    CheckInfo{tool_missing, "tool-missing", kWarning,
              "Cutting moves are made and no tool is called"},
    CheckInfo{length_missing, "length-missing", kWarning,
              "A tool cuts without its length being compensated"},
    CheckInfo{length_of_other_tool, "length-of-other-tool", kWarning,
              "The length in force is another tool's"},
    CheckInfo{arc_radii, "arc-radii", kWarning, "The radii at start and end of an arc disagree"},
    CheckInfo{arc_full_by_radius, "arc-full-by-radius", kError,
              "A full circle is given by its radius, which leaves its centre open"},
    CheckInfo{arc_nearly_full, "arc-nearly-full", kWarning,
              "An arc ends a little before its start and so runs nearly a full turn"},
    CheckInfo{arc_tiny, "arc-tiny", kNote, "An arc has a radius below 0.01 mm"},
    CheckInfo{arc_huge, "arc-huge", kNote, "An arc has a radius above 10 m"},
    CheckInfo{radius_gouge, "radius-gouge", kError,
              "The tool does not fit into a corner or arc of its contour"},
    CheckInfo{radius_compensation, "radius-compensation", kError,
              "Radius compensation begins, goes on or ends where it cannot"},
    CheckInfo{short_segments, "short-segments", kNote, "Cutting moves are shorter than 0.005 mm"},
    CheckInfo{tip_control_off, "tip-control-off", kWarning,
              "Rotary and linear axes cut together with the tool centre point control off"},
    CheckInfo{rotary_with_length, "rotary-with-length", kNote,
              "A rotary axis turns under a tool length, with the tool centre point control off"},
    CheckInfo{end_tip_control, "end-tip-control", kWarning,
              "The program ends with the tool centre point control on"},
    CheckInfo{end_incremental, "end-incremental", kWarning, "The program ends in G91"},
    CheckInfo{end_inverse_time, "end-inverse-time", kWarning, "The program ends in G93"},
    CheckInfo{end_tilted_plane, "end-tilted-plane", kWarning, "The program ends in a tilted plane"},
    CheckInfo{end_shifted_frame, "end-shifted-frame", kWarning,
              "The program ends with a shift or turn of its coordinates in force"},
    CheckInfo{end_spindle, "end-spindle", kWarning, "The program ends with the spindle on"},
    CheckInfo{end_coolant, "end-coolant", kNote, "The program ends with the coolant on"},
    CheckInfo{end_no_retract, "end-no-retract", kWarning,
              "The program ends where it cut, without a retract"},
    CheckInfo{setup_assumed, "setup-assumed", kNote,
              "A tool length or work offset is not known and taken as zero", Needs::machine},
    CheckInfo{unknown_axis, "unknown-axis", kError, "The machine has no such axis", Needs::machine},
    CheckInfo{unreachable_orientation, "unreachable-orientation", kError,
              "The machine cannot bring the tool into a direction", Needs::machine},
    CheckInfo{machine_refuses, "machine-refuses", kError, "The machine cannot make a move",
              Needs::machine},
    CheckInfo{over_travel, "over-travel", kError, "A linear axis leaves its travel",
              Needs::machine},
    CheckInfo{rotary_over_travel, "rotary-over-travel", kError, "A rotary axis leaves its travel",
              Needs::machine},
    CheckInfo{axis_too_slow, "axis-too-slow", kWarning,
              "The feed asks an axis for more than its greatest speed", Needs::machine},
    CheckInfo{rapid_in_material, "rapid-in-material", kError, "A rapid goes through material",
              Needs::job},
    CheckInfo{body_in_material, "body-in-material", kError,
              "A shank or holder is in the material during a cut", Needs::job},
    CheckInfo{machine_collision, "machine-collision", kError,
              "Bodies of machine, fixtures, tool and blank meet", Needs::job},
    CheckInfo{unknown_suppression, "unknown-suppression", kWarning,
              "A comment that suppresses findings names no check"},
    CheckInfo{unused_suppression, "unused-suppression", kWarning,
              "A comment suppresses findings that there are none of"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kChecks.size(); ++i) {
    if (kChecks[i].check != static_cast<Check>(i)) return false;
  }
  return true;
}
static_assert(in_order());

// What the text says of itself.
constexpr std::array kWithoutCaller{
    program_error, unused_label, unreachable_code, duplicate_number,
    not_simulated, builder_word, decimal_point,    unknown_suppression,
};

}  // namespace

std::span<const CheckInfo> all_checks() { return kChecks; }

const CheckInfo& info_of(Check check) { return kChecks.at(static_cast<std::size_t>(check)); }

std::optional<Check> check_named(std::string_view id) {
  const auto* found = std::find_if(kChecks.begin(), kChecks.end(),
                                   [id](const CheckInfo& info) { return info.id == id; });
  if (found == kChecks.end()) return std::nullopt;
  return found->check;
}

std::string check_meant_by(const std::string& id) {
  std::vector<std::string> known;
  for (const CheckInfo& info : kChecks) known.emplace_back(info.id);
  return suggestion(id, known);
}

bool needs_no_caller(Check check) {
  return std::ranges::find(kWithoutCaller, check) != kWithoutCaller.end();
}

}  // namespace frustum::lint

// The checks that a program is held against: what each is called and how grave it is.
//
// Units : none
// Errors: none; check_named() returns nothing for an unknown name
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"

namespace frustum::lint {

// In the order of kChecks (check.cpp).
enum class Check : std::uint8_t {
  program_error,
  missing_subprogram,
  missing_label,
  recursion,
  endless_loop,
  too_many_errors,
  unused_subprogram,
  unused_label,
  unreachable_code,
  duplicate_number,
  no_program_end,
  parameter_unset,
  vacant_word,
  not_simulated,
  builder_word,
  assumed,
  decimal_point,
  feed_missing,
  feed_high,
  feed_low,
  inverse_time_speed,
  spindle_off,
  spindle_hand,
  tool_missing,
  length_missing,
  length_of_other_tool,
  arc_radii,
  arc_full_by_radius,
  arc_nearly_full,
  arc_tiny,
  arc_huge,
  radius_gouge,
  radius_compensation,
  short_segments,
  tip_control_off,
  rotary_with_length,
  end_tip_control,
  end_incremental,
  end_inverse_time,
  end_tilted_plane,
  end_shifted_frame,
  end_spindle,
  end_coolant,
  end_no_retract,
  setup_assumed,
  unknown_axis,
  unreachable_orientation,
  machine_refuses,
  over_travel,
  rotary_over_travel,
  axis_too_slow,
  rapid_in_material,
  body_in_material,
  machine_collision,
  unknown_suppression,
  unused_suppression,
};

// What a check looks at beyond the program.
enum class Needs : std::uint8_t { nothing, machine, job };

struct CheckInfo {
  Check check;
  std::string_view id;  // "over-travel", as --disable and SARIF have it
  Severity severity;    // a finding may be graver or milder
  std::string_view title;
  Needs needs = Needs::nothing;
};

[[nodiscard]] std::span<const CheckInfo> all_checks();
[[nodiscard]] const CheckInfo& info_of(Check check);
[[nodiscard]] std::optional<Check> check_named(std::string_view id);
// "did you mean feed-low?", for an id that is none.
[[nodiscard]] std::string check_meant_by(const std::string& id);
// Whether it holds of a subprogram, whatever its callers have set.
[[nodiscard]] bool needs_no_caller(Check check);

}  // namespace frustum::lint

// A rigid tap among motions: in by the lead, the spindle reversed at the bottom, out again.
//
// Units : none
// Errors: none; what keeps motions from being one tap is said in words
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "parser/motion.hpp"

namespace frustum::parser {

struct RigidTapMotions {
  bool reverses = false;        // the spindle does, where the move ends
  std::string_view obstacle{};  // "a tap that ..": why it is not in and out at once; empty: it is
  std::size_t after = 0;        // the motions after the move in that belong to the tap
  // The tool cuts on with the spindle as it came out, which no motion says again.
  std::optional<SpindleChange> left{};
};

// `in` follows the spindle, which turns as `turning`, from `start`; `rest` comes after it.
[[nodiscard]] RigidTapMotions rigid_tap_of(const LinearFeed& in, const SpindleChange& turning,
                                           const AxisTarget& start, std::span<const Motion> rest);

}  // namespace frustum::parser

// A rigid tap among motions: in by the lead, the spindle reversed at the bottom, out again; or in
// strokes, each by the lead, in with the spindle one way round and out the other way.
//
// Units : none
// Errors: none; what keeps motions from being one tap is said in words
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "parser/motion.hpp"
#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/motion_words.hpp"
#include "parser/writing/nc_lines.hpp"

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

// One way, in or out along Z.
struct TapStroke {
  double z = 0.0;
  double speed = 0.0;  // of the spindle, 1/min
  bool out = false;
  double dwell_before = 0.0;  // seconds
};
struct TapStrokes {
  std::string_view obstacle{};  // why it is none
  bool right_handed = true;
  std::vector<TapStroke> strokes{};
  std::size_t after = 0;                // the motions after the first one that belong to them
  std::optional<SpindleChange> left{};  // as in RigidTapMotions
};
[[nodiscard]] TapStrokes tap_strokes_of(const LinearFeed& in, const SpindleChange& turning,
                                        const AxisTarget& start, std::span<const Motion> rest);
// Their lines, from the speed of the spindle in force on.
[[nodiscard]] std::string strokes_text(const TapStrokes& tap, const Feed& feed, double speed,
                                       const NcSpelling& spelling, const MotionWords& words,
                                       int feed_digits);

// Cycles tap along Z, from a place that is known, with the tool where the axes are (not guided).
[[nodiscard]] std::string_view obstacle_to_cycle(const MotionWords& words, const LinearFeed& move,
                                                 bool guided);

}  // namespace frustum::parser

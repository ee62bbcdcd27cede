// Motions and the calls that the stand-alone RS-274 interpreter prints, brought to one form for
// comparison.
//
// Units: mm, degrees, seconds, mm/min; positions in machine coordinates, work offsets at zero at
//        the start
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "parser/motion.hpp"

namespace frustum::parser {

struct CanonicalMove {
  std::string kind{};  // "traverse", "feed", "arc xy", "dwell", "tool", ...
  std::vector<std::optional<double>> values{};  // absent: the program does not know it
  double unit = 1.0;                            // mm in what the values were printed in
  std::optional<double> rate{};                 // of a feed move in G94 or G95: mm/min, deg/min, mm
  std::optional<double> spindle{};              // 1/min, clockwise above zero
};

// Z is unknown while a tool's length is in force that only the setup has.
[[nodiscard]] std::vector<CanonicalMove> moves_of(const std::vector<Motion>& motions);
// Of lines such as "   12 N..... STRAIGHT_FEED(1.0000, ...)".
[[nodiscard]] std::vector<CanonicalMove> moves_of_rs274(std::string_view output);

// Leaves out straight moves to where the tool is.
[[nodiscard]] std::vector<CanonicalMove> without_standing_still(std::vector<CanonicalMove> moves);

// "feed 1.0 2.0 3.0 0 0 0 feed 100 spindle 1000"
[[nodiscard]] std::string to_text(const CanonicalMove& move);
// The same kind, and what both know within 1e-4.
[[nodiscard]] bool agree(const CanonicalMove& a, const CanonicalMove& b);

}  // namespace frustum::parser

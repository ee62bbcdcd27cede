// Numbers as NC programs write them.
//
// Units    : the caller's
// Errors   : none
// Accuracy : half a unit of the last decimal
#pragma once

#include <cstdint>
#include <string>

namespace frustum::parser {

// How a number ends: "12." keeps its point (controllers read "12" in their least increment), "12"
// does not.
enum class WholeNumbers : std::uint8_t { with_point, without_point };

// Fixed decimals without trailing zeros, never an exponent, never "-0".
[[nodiscard]] std::string fixed(double value, int decimals,
                                WholeNumbers ending = WholeNumbers::with_point);
// As many decimals as that many significant digits need; for feeds.
[[nodiscard]] std::string significant(double value, int digits);

// With a + unless it is below zero.
[[nodiscard]] std::string with_sign(std::string number);
// With a point at its end when it has none.
[[nodiscard]] std::string with_point(std::string number);

}  // namespace frustum::parser

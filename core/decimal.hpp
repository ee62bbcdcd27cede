// Numbers as decimal text, never with an exponent.
//
// Units    : the caller's
// Errors   : none; of numbers that are not finite the text is that of C
// Accuracy : stated by each
#pragma once

#include <string>

namespace frustum {

// The shortest text that reads back as exactly `value`.
[[nodiscard]] std::string shortest_decimal(double value);

// The number of at most 15 digits that a stated number was, before it was converted to another unit
// and back: within the four roundings of that. Any other number is what it is.
[[nodiscard]] double as_stated(double value);

// That many decimals, to half a unit of the last; never a negative zero.
[[nodiscard]] std::string fixed_decimal(double value, int decimals);

}  // namespace frustum

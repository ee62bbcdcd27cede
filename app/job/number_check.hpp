// Checks of numbers on the command line that CLI11's own let slip.
// Units: none. Errors: the text that the command line shows when a check fails; empty when it holds.
#pragma once

#include <functional>
#include <string>

namespace frustum::app {

// A finite number above 0 and at most `largest`; "nan" is none.
[[nodiscard]] std::function<std::string(const std::string&)> positive_number(double largest = 1e12);

}  // namespace frustum::app

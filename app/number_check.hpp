// Checks of numbers on the command line that CLI11's own let slip.
// Units: none. Errors: the text that CLI11 shows when a check fails.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace frustum::app {

// A finite number above 0 and at most `largest`; "nan" is none.
[[nodiscard]] inline CLI::Validator positive_number(double largest = 1e12) {
  return CLI::Validator(
      [largest](std::string& text) -> std::string {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        if (is_number && value > largest)
          return fmt::format("must be at most {:g}, is {}", largest, text);
        return is_number && value > 0.0 ? "" : "must be a number above 0, is " + text;
      },
      "POSITIVE");
}

}  // namespace frustum::app

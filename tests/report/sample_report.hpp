// A made-up run with something in every part of the report.
#pragma once

#include "report/run_report.hpp"

namespace frustum::report {

// An inclined cone on a round base; `rings` and `steps` set how fine the surface is.
[[nodiscard]] RunReport sample_report(std::size_t steps = 120, std::size_t rings = 12);

// A block with that many step patterns, up to eleven: of each dL, dH, theta, phi and dL0, with the
// profiles of their lines.
[[nodiscard]] RunReport step_report(std::size_t patterns = 11);

// Two characteristics, one error, one collision: small enough to read as text.
[[nodiscard]] RunReport small_report();

}  // namespace frustum::report

// Numbers that formulas share.
// Units: as each says. Errors: none.
#pragma once

#include <limits>
#include <numbers>

namespace frustum {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2.0 * std::numbers::pi;  // rad: once round
constexpr double kSecondsPerMinute = 60.0;
constexpr double kMillisecondsPerSecond = 1000.0;

}  // namespace frustum

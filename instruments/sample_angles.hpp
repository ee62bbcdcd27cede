// At which angles a test is sampled.
//
// Units  : rad
// Errors : none
#pragma once

#include <vector>

namespace frustum::instruments {

// The middles of `count` equal parts of from .. to: never on a reversal at a multiple of 90 deg.
[[nodiscard]] std::vector<double> midpoints(double from, double to, int count);

// 3,600 a turn: what a bar samples on a slow circle.
constexpr int kSamplesOfATurn = 3600;

}  // namespace frustum::instruments

// Accuracy and repeatability of positioning of an axis.
//
// Model    : at target i mean and sd (n - 1) of the runs up and down;
//              B_i = mean up - mean down, B = max |B_i|
//              R_i = max(2 s_up + 2 s_down + |B_i|, 4 s_up, 4 s_down), R = max R_i
//              E   = largest less smallest of all unidirectional means
//              M   = range of the means of both directions
//              A   = max(mean + 2 s) - min(mean - 2 s) over both directions
// Units    : any, the same in and out
// Shape    : a row a target, as many runs in each; at least two runs
// Errors   : fewer than two targets or runs, rows of different lengths
// Accuracy : rounding (tests/instruments/positioning_test.cpp)
// Source   : ISO 230-2, by its name
#pragma once

#include <vector>

#include "core/result.hpp"

namespace frustum::instruments {

// Deviations by target, then by run.
using Deviations = std::vector<std::vector<double>>;

struct DirectionValues {
  std::vector<double> mean{}, sd{};  // by target
  double repeatability = 0.0;        // R: 4 s, the largest
  double systematic = 0.0;           // E: range of the means
  double accuracy = 0.0;             // A
};

struct Positioning {
  DirectionValues up{}, down{};
  std::vector<double> reversal{};          // B_i
  double largest_reversal = 0.0;           // B
  double mean_reversal = 0.0;              // mean of B_i
  std::vector<double> repeatability_at{};  // R_i
  double repeatability = 0.0;              // R
  double systematic = 0.0;                 // E
  double mean_range = 0.0;                 // M
  double accuracy = 0.0;                   // A
};

[[nodiscard]] Result<Positioning> positioning(const Deviations& up, const Deviations& down);

}  // namespace frustum::instruments

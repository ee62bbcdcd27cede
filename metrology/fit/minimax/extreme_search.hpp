// The best of many minimax solutions: minima near a start and elsewhere, compared.
//
// Model    : the start, points of a sequence that fills the steps which change distances by up to
//            ten times their level, and starts elsewhere; each goes down to its own minimum. Steps
//            beyond a start's level reach every minimum that is better than it, where distances are
//            nearly linear
// Units    : local frame of size one, rad
// Shape    : n points
// Errors   : `solution.proven` is false when no start led to a plausible, proven minimum
// Accuracy : that of minimax.hpp; of several minima the best of those found
// Source   : Roberts 2018, quasirandom sequences from roots of x^(k+1) = x + 1
#pragma once

#include <span>
#include <vector>

#include "metrology/fit/minimax/extreme_shape.hpp"

namespace frustum::metrology {

struct ExtremeSearch {
  const ExtremeKind* kind = nullptr;
  MinimaxProblem problem{};
  PlacedElement start{};
  std::vector<PlacedElement> elsewhere{};
  // Tilts beyond this of the start's frame belong to another element: 0.5 for those that are
  // inscribed.
  double most_tilt = 1e6;
};

struct ExtremeFound {
  PlacedElement placed{};
  MinimaxSolution solution{};
  int starts = 0;
  int iterations = 0;  // of all starts
};

[[nodiscard]] ExtremeFound best_extreme(const ExtremeSearch& search, std::span<const Vec3> points);

}  // namespace frustum::metrology

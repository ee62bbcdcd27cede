#include "parser/interpret/cycles/drilling_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustum::parser {
namespace {

using enum CycleAction;

// How far above the last depth the tool comes back by rapid.
double distance_before(const DrillingCycle& cycle) {
  constexpr double kShallow = 30.0;
  constexpr double kOfShallow = 0.6;
  constexpr double kShare = 1.0 / 50.0;
  constexpr double kMost = 7.0;
  if (cycle.near) return *cycle.near;
  const double depth = cycle.reference - cycle.bottom;
  return depth <= kShallow ? kOfShallow : std::min(depth * kShare, kMost);
}

std::vector<CycleStep> peck_steps(const DrillingCycle& cycle) {
  std::vector<CycleStep> steps;
  const auto wait = [&](double seconds) {
    if (seconds > 0.0) steps.push_back({dwell, seconds});
  };
  const std::vector<double> depths = pecks(cycle);
  const double near = distance_before(cycle);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double depth = cycle.reference - depths[i];
    steps.push_back({feed, depth, false, i == 0 ? cycle.first_feed : 1.0});
    if (i + 1 == depths.size()) break;
    wait(cycle.dwell_below);
    if (!cycle.clears) {
      steps.push_back({feed, std::min(depth + cycle.chip, cycle.level)});
      continue;
    }
    steps.push_back({rapid, cycle.level});
    wait(cycle.dwell_above);
    steps.push_back({rapid, std::min(depth + near, cycle.level)});
  }
  if (depths.empty()) return {};
  wait(cycle.dwell);
  steps.push_back({rapid, cycle.back});
  return steps;
}

}  // namespace

// The first stroke; each after it shorter by the amount or factor, down to the amount or the least;
// the last two of an amount share what is left.
std::vector<double> pecks(const DrillingCycle& cycle) {
  // What is left below this is rounding.
  constexpr double kNothing = 1e-9;
  const double total = cycle.reference - cycle.bottom;
  std::vector<double> depths;
  double stroke = cycle.first;
  double depth = std::min(stroke, total);
  depths.push_back(depth);
  while (total - depth > kNothing) {
    const double left = total - depth;
    if (static_cast<double>(depths.size()) >= kMostPecks || !(stroke > kNothing)) return {};
    if (cycle.degression > 0.0) {
      const bool at_least = stroke - cycle.degression <= cycle.degression;
      stroke = std::max(stroke - cycle.degression, cycle.degression);
      if (at_least && left > stroke && left <= 2.0 * stroke) stroke = left / 2.0;
    } else if (cycle.degression < 0.0) {
      stroke = std::max(-stroke * cycle.degression, cycle.least);
    }
    const bool last = left - stroke <= kNothing;
    depth = last ? total : depth + stroke;
    depths.push_back(depth);
  }
  return depths;
}

std::vector<CycleStep> steps_of(const DrillingCycle& c) {
  const bool dwells = c.dwell > 0.0;
  std::vector<CycleStep> steps;
  if (c.kind == DrillingWord::peck) return peck_steps(c);
  steps.push_back({feed, c.bottom});
  if (dwells) steps.push_back({dwell, c.dwell});
  switch (c.kind) {
    case DrillingWord::tap:
      steps.push_back({reverse_spindle, c.speed_back});
      steps.push_back({feed, c.level});
      break;
    case DrillingWord::ream:
    case DrillingWord::bore:
      steps.push_back({feed, c.level});
      break;
    case DrillingWord::bore_oriented:
      steps.push_back({stop_spindle});
      steps.push_back({orient_spindle});
      steps.push_back({rapid, c.bottom + c.retract.z(), true});
      steps.push_back({rapid, c.level, true});
      break;
    case DrillingWord::bore_stop:
    case DrillingWord::bore_dwell:
      steps.push_back({stop_spindle});
      steps.push_back({wait});
      break;
    default:
      break;
  }
  steps.push_back({rapid, c.back});
  return steps;
}

std::optional<double> metric_lead(double size) {
  struct Thread {
    double size;
    double lead;
  };
  // ISO 261, coarse.
  constexpr std::array kThreads{Thread{3, 0.5},  Thread{4, 0.7},  Thread{5, 0.8},   Thread{6, 1},
                                Thread{8, 1.25}, Thread{10, 1.5}, Thread{12, 1.75}, Thread{14, 2},
                                Thread{16, 2},   Thread{18, 2.5}, Thread{20, 2.5},  Thread{22, 2.5},
                                Thread{24, 3},   Thread{27, 3},   Thread{30, 3.5},  Thread{33, 3.5},
                                Thread{36, 4},   Thread{39, 4},   Thread{42, 4.5},  Thread{45, 4.5},
                                Thread{48, 5}};
  const auto* found = std::find_if(kThreads.begin(), kThreads.end(),
                                   [&](const Thread& t) { return t.size == std::abs(size); });
  if (found == kThreads.end()) return std::nullopt;
  return size < 0.0 ? -found->lead : found->lead;
}

}  // namespace frustum::parser

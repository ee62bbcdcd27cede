#include "parser/interpret/cycles/drilling_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustum::parser {
namespace {

using enum CycleAction;

// How far above a depth that has been reached, below RFP, the tool comes back by rapid.
double distance_before(const DrillingCycle& cycle, double depth) {
  constexpr double kShallow = 30.0;
  constexpr double kOfShallow = 0.6;
  constexpr double kShare = 1.0 / 50.0;
  constexpr double kMost = 7.0;
  if (cycle.near) return *cycle.near;
  return depth <= kShallow ? kOfShallow : std::min(depth * kShare, kMost);
}

std::vector<CycleStep> peck_steps(const DrillingCycle& cycle) {
  std::vector<CycleStep> steps;
  const auto wait = [&](double seconds) {
    if (seconds > 0.0) steps.push_back({dwell, seconds});
  };
  const std::vector<double> depths = pecks(cycle);
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
    steps.push_back({rapid, std::min(depth + distance_before(cycle, depths[i]), cycle.level)});
  }
  if (depths.empty()) return {};
  wait(cycle.dwell);
  steps.push_back({rapid, cycle.back});
  return steps;
}

// The stroke after one of `planned`, which shrinks by the amount down to it: the last two share
// what is left, or the last but one leaves the amount to the last.
double next_by_amount(double& planned, double amount, double left) {
  planned = std::max(planned - amount, amount);
  if (left - planned >= amount) {
    if (left > 2.0 * amount) return planned;
    return left > amount ? left / 2.0 : left;
  }
  if (left <= planned) return left;
  return left > 2.0 * amount ? left - amount : left / 2.0;
}

// It shrinks by the factor down to the least one; when less than that would be left, the last two
// share.
double next_by_factor(double& planned, double factor, double least, double left) {
  planned = std::max(planned * factor, least);
  if (planned > left) return left;
  return left - planned >= least ? planned : left / 2.0;
}

}  // namespace

std::vector<double> pecks(const DrillingCycle& cycle) {
  // What is left below this is rounding.
  constexpr double kNothing = 1e-9;
  const double total = cycle.reference - cycle.bottom;
  // No degression is the factor 1, with the first stroke as the least.
  const double factor = cycle.degression == 0.0 ? 1.0 : -cycle.degression;
  const double least = cycle.degression == 0.0 ? cycle.first : cycle.least;
  std::vector<double> depths;
  double planned = cycle.first;
  double depth = std::min(planned, total);
  depths.push_back(depth);
  while (total - depth > kNothing) {
    const double left = total - depth;
    const double stroke = cycle.degression > 0.0 ? next_by_amount(planned, cycle.degression, left)
                                                 : next_by_factor(planned, factor, least, left);
    if (static_cast<double>(depths.size()) >= kMostPecks || !(stroke > kNothing)) return {};
    depth = left - stroke <= kNothing ? total : depth + stroke;
    depths.push_back(depth);
  }
  return depths;
}

namespace {

// Each depth of a tap, with the way back between them: to break the chip, or out of the hole.
std::vector<CycleStep> tap_steps(const DrillingCycle& cycle) {
  std::vector<CycleStep> steps;
  const auto wait = [&] {
    if (cycle.dwell > 0.0) steps.push_back({dwell, cycle.dwell});
  };
  const auto depths =
      cycle.first > 0.0 ? pecks(cycle) : std::vector<double>{cycle.reference - cycle.bottom};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double depth = cycle.reference - depths[i];
    if (i > 0) steps.push_back({start_spindle, cycle.speed});
    if (i > 0 && cycle.clears) {
      steps.push_back({feed, cycle.reference - depths[i - 1] + cycle.chip});
    }
    steps.push_back({feed, depth});
    wait();
    steps.push_back({reverse_spindle, cycle.speed_back});
    if (i + 1 == depths.size()) break;
    steps.push_back({feed, cycle.clears ? cycle.level : std::min(depth + cycle.chip, cycle.level)});
    if (cycle.clears) wait();
  }
  steps.push_back({feed, cycle.level});
  steps.push_back({rapid, cycle.back});
  return steps;
}

}  // namespace

std::vector<CycleStep> steps_of(const DrillingCycle& c) {
  const bool dwells = c.dwell > 0.0;
  std::vector<CycleStep> steps;
  if (c.kind == DrillingWord::peck) return peck_steps(c);
  if (c.kind == DrillingWord::tap || c.kind == DrillingWord::floating_tap) return tap_steps(c);
  steps.push_back({feed, c.bottom});
  if (dwells) steps.push_back({dwell, c.dwell});
  switch (c.kind) {
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

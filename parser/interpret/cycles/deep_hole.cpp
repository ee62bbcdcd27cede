#include "parser/interpret/cycles/deep_hole.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::parser {
namespace {

using enum CycleAction;

// Of the depth: what is left below a peck is no peck of its own when it is rounding.
constexpr double kDepthRounding = 1e-12;

double peck_after(const DeepHole& hole, double peck) {
  if (hole.others) return *hole.others;
  return std::max(peck - hole.decrement, std::min(hole.least, peck));
}

// The depths that the pecks end at.
std::vector<double> ends_of(const DeepHole& hole) {
  std::vector<double> ends;
  double peck = hole.first;
  const double most = hole.depth * (1.0 - kDepthRounding);
  for (double end = peck; peck > 0.0 && end < most; end += peck) {
    ends.push_back(end);
    peck = peck_after(hole, peck);
  }
  ends.push_back(hole.depth);
  return ends;
}

}  // namespace

double peck_count(const DeepHole& hole) {
  double count = 1.0;
  double peck = hole.first;
  double end = peck;
  while (peck > 0.0 && end < hole.depth && count <= kMostPecks) {
    count += 1.0;
    peck = peck_after(hole, peck);
    end += peck;
  }
  const bool vanish = hole.first > 0.0 && peck <= 0.0 && end < hole.depth;
  return vanish ? std::numeric_limits<double>::infinity()
                : count + (hole.break_each > 0.0 ? hole.depth / hole.break_each : 0.0);
}

std::vector<CycleStep> steps_at_deep_hole(const DeepHole& hole, double level, double clear) {
  std::vector<CycleStep> steps;
  const std::vector<double> ends = ends_of(hole);
  const auto clear_by = [](bool by_feed) { return by_feed ? feed : rapid; };
  int breaks_left = hole.breaks;
  double depth = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (hole.break_each > 0.0) {
      const double begin = depth;
      for (int n = 1; begin + n * hole.break_each < ends[i] * (1.0 - kDepthRounding); ++n) {
        depth = begin + n * hole.break_each;
        steps.push_back({feed, -depth});
        steps.push_back({rapid, std::min(hole.chip - depth, level)});
      }
    }
    depth = ends[i];
    steps.push_back({feed, -depth});
    if (i + 1 == ends.size()) break;
    if (breaks_left > 0) {
      --breaks_left;
      steps.push_back({rapid, std::min(hole.chip - depth, level)});
      continue;
    }
    breaks_left = hole.breaks;
    steps.push_back({clear_by(hole.clears_by_feed), level});
    if (hole.dwell_above > 0.0) steps.push_back({dwell, hole.dwell_above});
    // Of the ends but the last, the share of this one.
    const double share =
        ends.size() > 2 ? static_cast<double>(i) / static_cast<double>(ends.size() - 2) : 0.0;
    const double stop = std::lerp(hole.first_stop, hole.last_stop, share);
    steps.push_back({rapid, std::min(stop - depth, level)});
  }
  if (hole.dwell > 0.0) steps.push_back({dwell, hole.dwell});
  steps.push_back({clear_by(hole.leaves_by_feed), level});
  steps.push_back({rapid, clear});
  return steps;
}

}  // namespace frustum::parser

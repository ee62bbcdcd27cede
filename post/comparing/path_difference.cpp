#include "post/comparing/path_difference.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::post {
namespace {

using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::PathMatch;
using kinematics::ToolPath;

// Times are compared over segments of at least this long: a shorter one is mostly its own corners.
constexpr double kTimeWindow = 0.2;  // s

struct Found {
  DifferenceKind kind = DifferenceKind::none;
  std::size_t match = 0;
  double time_ratio = 1.0;
  bool throughout = false;
};

bool apart(const PathMatch& match, const DifferenceLimits& limits) {
  return match.tip_distance() > limits.tip || match.axis_angle() > limits.axis;
}

// The first match that is apart, or that another tool makes.
Found first_apart(const ToolPath& reference, const ToolPath& other,
                  const std::vector<PathMatch>& matches, const DifferenceLimits& limits) {
  const auto another_tool = [&](const PathMatch& m) {
    return reference.blocks[m.reference.block].tool != other.blocks[m.other.block].tool;
  };
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const PathMatch& m = matches[i];
    if (m.tip_distance() > limits.tip) return {DifferenceKind::tip, i};
    if (m.axis_angle() > limits.axis) return {DifferenceKind::axis, i};
    // Where a tool begins at which another one ended, both are the nearest.
    const bool last = i + 1 == matches.size();
    if (another_tool(m) && (last || another_tool(matches[i + 1]))) {
      return {DifferenceKind::tool, i};
    }
  }
  return {};
}

bool farther_from_one(double a, double b) { return std::abs(std::log(a)) > std::abs(std::log(b)); }

// Ratio of the times of both paths, window by window; the first that is off, and the worst.
Found compare_times(const std::vector<PathMatch>& matches, const DifferenceLimits& limits,
                    double& worst) {
  Found found;
  std::size_t start = 0, windows = 0, alike = 0;
  for (std::size_t i = 1; i < matches.size(); ++i) {
    const double reference = matches[i].reference.time - matches[start].reference.time;
    const double other = matches[i].other.time - matches[start].other.time;
    if (std::max(reference, other) < kTimeWindow) continue;
    const double ratio = reference > 0.0 && other > 0.0 ? other / reference
                         : other > 0.0                  ? 1e9
                                                        : 1e-9;
    if (farther_from_one(ratio, worst)) worst = ratio;
    const bool off = std::abs(std::log(ratio)) > std::log1p(limits.time_ratio);
    if (off && found.kind == DifferenceKind::none) found = {DifferenceKind::feed, start + 1, ratio};
    ++windows;
    if (off && std::abs(std::log(ratio / found.time_ratio)) < std::log1p(limits.time_ratio))
      ++alike;
    start = i;
  }
  constexpr double kAlmostAll = 0.9;  // a window may be across a corner
  found.throughout = static_cast<double>(alike) >= kAlmostAll * static_cast<double>(windows);
  return found;
}

std::uint32_t line_of(const ToolPath& path, std::uint32_t block) {
  return path.blocks[block].source_line;
}

Difference described(const ToolPath& first, const ToolPath& second, const PathMatch& match,
                     const Found& found) {
  return {.kind = found.kind,
          .first_line = line_of(first, match.reference.block),
          .second_line = line_of(second, match.other.block),
          .tip = match.tip_distance(),
          .axis = match.axis_angle(),
          .time_ratio = found.time_ratio,
          .likely_cause = {}};
}

}  // namespace

bool has_feed(const ToolPath& path) {
  return std::any_of(path.blocks.begin(), path.blocks.end(),
                     [](const PathBlock& b) { return b.kind == PathKind::feed; });
}

PathDifference path_difference(const ToolPath& first, const ToolPath& second,
                               const DifferenceLimits& limits) {
  PathDifference result;
  if (!has_feed(first) || !has_feed(second)) {
    if (has_feed(first)) result.first.kind = DifferenceKind::missing;
    if (has_feed(second)) result.first.kind = DifferenceKind::extra;
    return result;
  }
  const auto forward = kinematics::match_paths(first, second);
  const auto backward = kinematics::match_paths(second, first);
  for (const auto* side : {&forward, &backward}) {
    for (const PathMatch& m : side->matches) {
      result.largest_tip = std::max(result.largest_tip, m.tip_distance());
      result.largest_axis = std::max(result.largest_axis, m.axis_angle());
    }
  }
  if (const Found found = first_apart(first, second, forward.matches, limits);
      found.kind != DifferenceKind::none) {
    result.first = described(first, second, forward.matches[found.match], found);
    return result;
  }
  // The first path is on the second one; what the second one does besides shows on the way back.
  const auto off = std::find_if(backward.matches.begin(), backward.matches.end(),
                                [&](const PathMatch& m) { return apart(m, limits); });
  if (off != backward.matches.end()) {
    result.first = {.kind = DifferenceKind::extra,
                    .first_line = line_of(first, off->other.block),
                    .second_line = line_of(second, off->reference.block),
                    .tip = off->tip_distance(),
                    .axis = off->axis_angle(),
                    .time_ratio = 1.0,
                    .likely_cause = {}};
    return result;
  }
  const Found slow = compare_times(forward.matches, limits, result.largest_time_ratio);
  if (slow.kind != DifferenceKind::none) {
    result.first = described(first, second, forward.matches[slow.match], slow);
    result.same_ratio_throughout = slow.throughout;
  }
  return result;
}

}  // namespace frustum::post

#include "post/comparing/path_difference.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

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

// The first match whose blocks differ in something that does not show in the path. Where a block
// begins at which another one ended, both are the nearest: two matches must show it, or the last.
template <class Value>
std::optional<std::size_t> first_unlike(const ToolPath& reference, const ToolPath& other,
                                        const std::vector<PathMatch>& matches, Value value) {
  const auto unlike = [&](const PathMatch& m) {
    return std::invoke(value, reference.blocks[m.reference.block]) !=
           std::invoke(value, other.blocks[m.other.block]);
  };
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const bool last = i + 1 == matches.size();
    if (unlike(matches[i]) && (last || unlike(matches[i + 1]))) return i;
  }
  return std::nullopt;
}

// The first match that is apart, or that another tool makes.
Found first_apart(const ToolPath& reference, const ToolPath& other,
                  const std::vector<PathMatch>& matches, const DifferenceLimits& limits) {
  const std::size_t another_tool =
      first_unlike(reference, other, matches, &PathBlock::tool).value_or(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const PathMatch& m = matches[i];
    if (m.tip_distance() > limits.tip) return {DifferenceKind::tip, i};
    if (m.axis_angle() > limits.axis) return {DifferenceKind::axis, i};
    if (i == another_tool) return {DifferenceKind::tool, i};
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

Found compare_spindles(const ToolPath& reference, const ToolPath& other,
                       const std::vector<PathMatch>& matches) {
  const auto at = first_unlike(reference, other, matches, &PathBlock::spindle_on);
  return at ? Found{DifferenceKind::spindle, *at} : Found{};
}

std::string file_of(const PathBlock& block) {
  return block.source_file ? *block.source_file : std::string();
}

// `match` goes from a block of the first path to one of the second.
Difference described(const PathBlock& first, const PathBlock& second, const PathMatch& match,
                     const Found& found) {
  return {.kind = found.kind,
          .first_line = first.source_line,
          .second_line = second.source_line,
          .first_file = file_of(first),
          .second_file = file_of(second),
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
  const auto at = [&](const PathMatch& match, const Found& found) {
    return described(first.blocks[match.reference.block], second.blocks[match.other.block], match,
                     found);
  };
  if (const Found found = first_apart(first, second, forward.matches, limits);
      found.kind != DifferenceKind::none) {
    result.first = at(forward.matches[found.match], found);
    return result;
  }
  // The first path is on the second one; what the second one does besides shows on the way back.
  const auto off = std::find_if(backward.matches.begin(), backward.matches.end(),
                                [&](const PathMatch& m) { return apart(m, limits); });
  if (off != backward.matches.end()) {
    result.first = described(first.blocks[off->other.block], second.blocks[off->reference.block],
                             *off, {DifferenceKind::extra});
    return result;
  }
  const Found slow = compare_times(forward.matches, limits, result.largest_time_ratio);
  if (slow.kind != DifferenceKind::none) {
    result.first = at(forward.matches[slow.match], slow);
    result.same_ratio_throughout = slow.throughout;
    return result;
  }
  if (const Found still = compare_spindles(first, second, forward.matches);
      still.kind != DifferenceKind::none) {
    result.first = at(forward.matches[still.match], still);
  }
  return result;
}

}  // namespace frustum::post

#include "post/comparing/trial_path.hpp"

#include <algorithm>
#include <utility>

#include "kinematics/controller/controller.hpp"
#include "kinematics/path/travel.hpp"

namespace frustum::post {

using kinematics::PathMatch;
using kinematics::ToolPath;

std::optional<kinematics::CommandedProgram> commanded_or_nothing(
    const kinematics::Machine& machine, const kinematics::Setup& setup,
    std::span<const parser::Motion> motions) {
  auto commanded = kinematics::command(machine, setup, motions, {.check_travel = false});
  if (!commanded) return std::nullopt;
  return *std::move(commanded);
}

ToolPath path_of(const kinematics::Machine& machine, const kinematics::Setup& setup,
                 const kinematics::CommandedProgram& commanded,
                 const kinematics::GeometricErrors& errors, PathSampling sampling,
                 const DifferenceLimits& limits) {
  constexpr double kNoBound = 1e9;  // mm
  const double bound = sampling == PathSampling::coarse ? kNoBound : 0.2 * limits.tip;
  return kinematics::travel(machine, setup, commanded, errors,
                            {.path_bound = bound, .time_law = {.limits = false}})
      .path;
}

std::optional<ToolPath> path_of(const kinematics::Machine& machine, const kinematics::Setup& setup,
                                std::span<const parser::Motion> motions, PathSampling sampling,
                                const DifferenceLimits& limits) {
  const auto commanded = commanded_or_nothing(machine, setup, motions);
  if (!commanded) return std::nullopt;
  return path_of(machine, setup, *commanded, {}, sampling, limits);
}

bool lies_on(const ToolPath& path, const ToolPath& first, const DifferenceLimits& limits) {
  const auto matches =
      kinematics::match_paths(path, first, {.stop_beyond = 2.0 * limits.tip}).matches;
  return std::all_of(matches.begin(), matches.end(), [&](const PathMatch& m) {
    return m.tip_distance() <= limits.tip && m.axis_angle() <= limits.axis;
  });
}

bool same_way(const ToolPath& first, const ToolPath& second, const DifferenceLimits& limits) {
  const DifferenceKind kind = path_difference(first, second, limits).first.kind;
  return kind == DifferenceKind::none || kind == DifferenceKind::feed;
}

}  // namespace frustum::post

// The road of cylinder and cone fits from candidate axes to the one minimum.
//
// Model    : every start descends on a thinned set, the best few on all points; the lowest settles
// Units    : local frame of size one
// Shape    : any Model of gauss_newton.hpp with `bool plausible() const`
// Errors   : no plausible minimum; not well posed; not converged
// Accuracy : that of gauss_newton.hpp
// Source   : ours
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "metrology/axis_search.hpp"
#include "metrology/gauss_newton.hpp"
#include "metrology/normalised_points.hpp"

namespace frustum::metrology {

inline constexpr std::size_t kAxisCandidates = 10;

template <typename Model>
[[nodiscard]] Result<Minimum<Model>> best_minimum(const std::vector<Model>& starts,
                                                  const NormalisedPoints& local,
                                                  std::string_view what) {
  // 80 points tell the right valley; twelve steps go far enough down to compare.
  const std::vector<Vec3> few = thinned(local.points, 80);
  std::vector<std::pair<double, Model>> ranked;
  for (const Model& start : starts) {
    GaussNewton<Model> solver(start, few);
    solver.descend(12);
    if (solver.model().plausible()) ranked.emplace_back(solver.cost(), solver.model());
  }
  const auto by_cost = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(ranked.begin(), ranked.end(), by_cost);
  std::vector<std::pair<double, GaussNewton<Model>>> finalists;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, ranked.size()); ++i) {
    GaussNewton<Model> solver(ranked[i].second, local.points);
    solver.descend(100);
    if (solver.model().plausible()) finalists.emplace_back(solver.cost(), std::move(solver));
  }
  if (finalists.empty()) {
    return error(fmt::format("degenerate points for a {}: none fits them", what),
                 "check that the points lie near one");
  }
  auto best = std::min_element(finalists.begin(), finalists.end(), by_cost);
  Minimum<Model> found = best->second.settle();
  if (!found.well_posed || !found.model.plausible()) {
    return error(
        fmt::format("degenerate points for a {}: they do not tell all of its parameters", what),
        "probe at two or more heights and around more of the circumference");
  }
  if (!found.converged) {
    return error(fmt::format("the {} fit did not converge in {} steps", what, found.iterations),
                 fmt::format("check that the points lie near a {}", what));
  }
  return found;
}

// Refuses points in one plane: a plane cuts cones and cylinders in curves that fit many of them.
[[nodiscard]] inline std::optional<Diagnostic> coplanar(const NormalisedPoints& local,
                                                        std::string_view what) {
  const PrincipalDirections principal = principal_directions(local);
  if (principal.spread[2] > kFlat * principal.spread[0]) return std::nullopt;
  return error(fmt::format("degenerate points for a {}: they lie in one plane", what),
               "probe at two or more heights along the axis");
}

}  // namespace frustum::metrology

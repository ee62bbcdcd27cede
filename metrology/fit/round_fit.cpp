#include "metrology/fit/round_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrology/fit/plausibility.hpp"
#include "metrology/fit/unmet_constraints.hpp"

namespace frustum::metrology {
namespace {

// Below this gain the cost no longer tells good steps from bad ones; settle() takes over.
constexpr double kLastGain = 1e-8;
// 80 points tell the right valley.
constexpr std::size_t kFew = 80;

// An axis without a sense of its own gets the one that equal data always get.
Element in_one_sense(const Element& element) {
  return std::visit(
      [](auto e) -> Element {
        if constexpr (
            requires { e.axis; } && !requires { e.half_angle; }) {
          e.axis = canonical(e.axis);
        }
        return e;
      },
      element);
}

// In one plane, unless the axis is given.
std::optional<Diagnostic> coplanar(const NormalisedPoints& local,
                                   const PrincipalDirections& principal, std::string_view what) {
  if (local.constraints.parallel_to || local.constraints.axis ||
      principal.spread[2] > kFlat * principal.spread[0]) {
    return std::nullopt;
  }
  return error("degenerate-points"_id,
               fmt::format("degenerate points for a {}: they are in one plane", what),
               "probe at two or more heights along the axis");
}

Constraints in_mm(Constraints keep, const NormalisedPoints& local) {
  if (keep.axis) keep.axis->point = local.back(keep.axis->point);
  if (keep.radius) *keep.radius *= local.scale;
  if (keep.tube_radius) *keep.tube_radius *= local.scale;
  return keep;
}

// Few points fit several elements, and a narrow arc one across it as well: the lowest may mean
// nothing.
bool is_doubtful(const NormalisedPoints& local, const Result<Minimum>& lowest) {
  constexpr std::size_t kFewToSpare = 3;
  constexpr double kFarOff = 0.5;  // sine of the angle between the axes
  if (!local.expected) return false;
  const std::size_t parameters = parameters_of(kind_of(*local.expected)).size();
  if (!lowest || local.count() <= parameters + kFewToSpare) return true;
  const Vec3 expected = *axis_of(*local.expected);
  return expected.cross(axis_of(lowest->element)->vec()).norm() > kFarOff;
}

// The minimum below the element that is expected, where its residuals are below a thousandth of the
// part.
std::optional<Minimum> expected_minimum(const NormalisedPoints& local, const PointBlocks& blocks,
                                        const Wording& wording) {
  constexpr double kLow = 1e-3;
  GaussNewton solver(constrained(*local.expected, local.constraints), blocks, local.constraints);
  solver.descend(100, kLastGain);
  if (!(solver.cost() < kLow * kLow * static_cast<double>(blocks.count))) return std::nullopt;
  auto found = settled(std::move(solver), blocks, local.constraints, wording);
  return found ? std::optional(*std::move(found)) : std::nullopt;
}

}  // namespace

Result<Minimum> settled(GaussNewton solver, const PointBlocks& points,
                        const Constraints& constraints, const Wording& wording) {
  const Element turned = in_one_sense(solver.element());
  const UnitVec3* axis = axis_of(turned);
  if (axis != nullptr && axis->vec().dot(axis_of(solver.element())->vec()) < 0.0) {
    solver = GaussNewton(turned, points, constraints);
  }
  Minimum found = solver.settle();
  const std::string_view what = wording.what;
  if (!found.well_posed) {
    return error(
        "degenerate-points"_id,
        fmt::format("degenerate points for a {}: they do not determine all of its parameters",
                    what),
        std::string(wording.remedy));
  }
  if (!found.converged) {
    return error("fit-not-converged"_id,
                 fmt::format("the {} fit did not converge in {} steps", what, found.iterations),
                 constraints.any()
                     ? fmt::format("check the points, and what the {} is to keep", what)
                     : fmt::format("the points are far from any {}", what));
  }
  if (auto reason = implausible(found.element)) {
    return error("degenerate-points"_id,
                 fmt::format("degenerate points for a {}: {}", what, *reason),
                 std::string(wording.remedy));
  }
  return found;
}

Result<Minimum> best_minimum(const std::vector<Element>& starts, const NormalisedPoints& local,
                             const PointBlocks& all, const Wording& wording) {
  const PointBlocks few = PointBlocks::of(thinned(local, kFew));
  const Constraints& keep = local.constraints;
  std::vector<std::pair<double, Element>> ranked;
  std::optional<std::string> reason;  // why a descent led nowhere
  for (const Element& start : starts) {
    GaussNewton solver(start, few, keep);
    solver.descend(12, kLastGain);  // far enough down to compare
    if (auto astray = implausible(solver.element())) {
      reason = std::move(astray);
    } else if (std::isfinite(solver.cost())) {
      ranked.emplace_back(solver.cost(), solver.element());
    }
  }
  const auto by_cost = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(ranked.begin(), ranked.end(), by_cost);
  std::vector<std::pair<double, GaussNewton>> finalists;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, ranked.size()); ++i) {
    GaussNewton solver(ranked[i].second, all, keep);
    solver.descend(100, kLastGain);
    if (auto astray = implausible(solver.element())) {
      reason = std::move(astray);
    } else {
      finalists.emplace_back(solver.cost(), std::move(solver));
    }
  }
  if (finalists.empty()) {
    return error("degenerate-points"_id,
                 fmt::format("degenerate points for a {}: {}", wording.what,
                             reason.value_or("none fits them")),
                 fmt::format("check that the points are near a {}", wording.what));
  }
  const auto best = std::min_element(finalists.begin(), finalists.end(), by_cost);
  return settled(best->second, all, keep, wording);
}

std::optional<GaussNewton> at_once(const std::vector<Element>& starts,
                                   const NormalisedPoints& local, const PointBlocks& all,
                                   double least_spread) {
  const PointBlocks few = PointBlocks::of(thinned(local, kFew));
  const double enough = 1e-6 * least_spread * least_spread;
  for (const Element& start : starts) {
    GaussNewton solver(start, few, local.constraints);
    solver.descend(12, 1e-2);
    if (implausible(solver.element()) ||
        !(solver.cost() < enough * static_cast<double>(few.count))) {
      continue;
    }
    GaussNewton whole(solver.element(), all, local.constraints);
    if (whole.cost() < enough * static_cast<double>(all.count)) return whole;
  }
  return std::nullopt;
}

std::vector<Bend> bends_along(const Vec3& direction) {
  std::vector<Bend> bends;
  for (const double radius : {0.2, 0.5, 1.0, 2.0, 5.0, 20.0}) {
    for (const double side : {1.0, -1.0}) bends.push_back({side * radius * direction, radius});
  }
  return bends;
}

double redundancy(const NormalisedPoints& local, const Minimum& found) {
  return static_cast<double>(local.count()) - static_cast<double>(found.free_parameters);
}

std::optional<Minimum> nearby_minimum(const NormalisedPoints& local, const Wording& wording) {
  const PrincipalDirections principal = principal_directions(local);
  if (!local.expected || coplanar(local, principal, wording.what)) return std::nullopt;
  const PointBlocks all = PointBlocks::of(local);
  GaussNewton solver(constrained(shifted(*local.expected, Vec3::Zero()), local.constraints), all,
                     local.constraints);
  // An element so near to the points, for their least extent, is in the valley of the lowest one:
  // none on the far side of them, or across them, comes as near.
  constexpr double kNear = 1e-2;
  const double near = kNear * principal.spread[2];
  if (!(solver.cost() < near * near * static_cast<double>(all.count))) return std::nullopt;
  solver.descend(6, 1e-2);
  if (implausible(solver.element())) return std::nullopt;
  auto found = settled(std::move(solver), all, local.constraints, wording);
  if (!found || is_doubtful(local, found)) return std::nullopt;
  return *std::move(found);
}

Result<Minimum> axial_minimum(const NormalisedPoints& local, const Wording& wording,
                              AxialStarts initial_estimates, AxialStarts all) {
  const PrincipalDirections principal = principal_directions(local);
  if (auto flat = coplanar(local, principal, wording.what)) return *flat;
  const NormalisedPoints few = thinned(local, kSearched);
  const AxialPoints points{local, principal, few, AxisSearch(few, principal)};
  const PointBlocks blocks = PointBlocks::of(local);
  auto direct = at_once(initial_estimates(points), local, blocks, principal.spread[2]);
  auto lowest = direct ? settled(std::move(*direct), blocks, local.constraints, wording)
                       : best_minimum(all(points), local, blocks, wording);
  if (!is_doubtful(local, lowest)) return lowest;
  auto meant = expected_minimum(local, blocks, wording);
  return meant ? Result<Minimum>(*std::move(meant)) : lowest;
}

Result<Minimum> solved(const NormalisedPoints& local, const Solve& solve, std::string_view what) {
  auto found = solve(local);
  if (found || !local.constraints.any()) return found;
  NormalisedPoints free = local;
  free.constraints = {};
  const auto without = solve(free);
  if (!without) return found;
  const Constraints keep = in_mm(local.constraints, local);
  if (auto told = unmet(keep, in_mm(without->element, local), what)) return *told;
  return found;
}

Element in_mm(const Element& element, const NormalisedPoints& local) {
  return std::visit(
      [&](auto e) -> Element {
        e.point = local.back(e.point);
        if constexpr (requires { e.radius; }) e.radius *= local.scale;
        if constexpr (requires { e.tube_radius; }) e.tube_radius *= local.scale;
        return e;
      },
      element);
}

std::array<bool, kMostParameters> angles_of(ElementKind kind) {
  std::array<bool, kMostParameters> angles{};
  const std::span<const Parameter> parameters = parameters_of(kind);
  std::transform(parameters.begin(), parameters.end(), angles.begin(), is_angle);
  return angles;
}

}  // namespace frustum::metrology

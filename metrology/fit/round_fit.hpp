// The road of fits from starting elements to the one minimum.
//
// Model    : every start descends on a thinned set, the best few on all points; the lowest settles
// Units    : local frame of size one
// Shape    : the kinds of gauss_newton.hpp; all starts of one kind
// Errors   : no plausible minimum; not well posed; not converged
// Accuracy : that of gauss_newton.hpp
// Source   : ours
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/fit/axis_search.hpp"
#include "metrology/fit/gauss_newton.hpp"
#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

// How to speak to the user about points that do not tell an element.
struct Wording {
  std::string_view what;
  std::string_view remedy;
};

// This many points tell the right valley, and their moments the axes.
inline constexpr std::size_t kSearched = 160;
inline constexpr std::size_t kAxisCandidates = 10;

// One start a candidate: what start(candidate) makes of it.
template <typename Start>
[[nodiscard]] std::vector<Element> starts_from(const std::vector<AxisCandidate>& candidates,
                                               const Start& start) {
  std::vector<Element> starts;
  starts.reserve(candidates.size());
  for (const AxisCandidate& c : candidates) starts.push_back(start(c));
  return starts;
}

// From an element in the right valley.
[[nodiscard]] Result<Minimum> settled(GaussNewton solver, const PointBlocks& points,
                                      const Constraints& constraints, const Wording& wording);

[[nodiscard]] Result<Minimum> best_minimum(const std::vector<Element>& starts,
                                           const NormalisedPoints& local, const PointBlocks& all,
                                           const Wording& wording);

// The minimum below the initial_estimates of few starts, when it is so low that there is nothing to
// search for: residuals a thousandth of the least spread of the points bend no surface into
// another.
[[nodiscard]] std::optional<GaussNewton> at_once(const std::vector<Element>& starts,
                                                 const NormalisedPoints& local,
                                                 const PointBlocks& all, double least_spread);

// Circles and spheres through the middle of the points that bend to either side of them, little and
// much: starts where the points are so rough that the algebraic one may be in the wrong valley.
struct Bend {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};
[[nodiscard]] std::vector<Bend> bends_along(const Vec3& direction);

[[nodiscard]] double redundancy(const NormalisedPoints& local, const Minimum& found);

// What the fits along an axis start from.
struct AxialPoints {
  const NormalisedPoints& local;
  PrincipalDirections principal{};
  NormalisedPoints few{};  // kSearched of them
  AxisSearch axes;
};
using AxialStarts = std::vector<Element> (*)(const AxialPoints& points);

// The minimum below the initial_estimates starts, when they fit at once, or below the best of all.
// Refuses points in one plane: a plane cuts cones, cylinders and tori in curves that fit many of
// them, unless their axis is given.
[[nodiscard]] Result<Minimum> axial_minimum(const NormalisedPoints& local, const Wording& wording,
                                            AxialStarts initial_estimates, AxialStarts all);

// The minimum below the element that is expected, where the points are so near to it that there is
// nothing to search for: within a hundredth of their least extent.
[[nodiscard]] std::optional<Minimum> nearby_minimum(const NormalisedPoints& local,
                                                    const Wording& wording);

// What `solve` finds; where it finds nothing, and would without the constraints, what they
// contradict.
using Solve = std::function<Result<Minimum>(const NormalisedPoints& local)>;
[[nodiscard]] Result<Minimum> solved(const NormalisedPoints& local, const Solve& solve,
                                     std::string_view what);

// In mm, in the frame of the points.
[[nodiscard]] Element in_mm(const Element& element, const NormalisedPoints& local);
[[nodiscard]] std::array<bool, kMostParameters> angles_of(ElementKind kind);

// The whole fit of an element whose covariance is that of its parameters.
template <typename E>
[[nodiscard]] Result<Fit<E>> round_fit(std::span<const Vec3> points, const FitOptions& options,
                                       const Needed& needed, const Solve& solve) {
  auto local = normalise(points, needed, options);
  if (!local) return std::move(local).error();
  auto found = solved(*local, solve, needed.what);
  if (!found) return std::move(found).error();
  const auto is_angle = angles_of(needed.kind);
  return completed(*local, std::get<E>(in_mm(found->element, *local)),
                   {found->residuals, found->cofactor, is_angle, redundancy(*local, *found),
                    found->iterations, found->condition});
}

}  // namespace frustum::metrology

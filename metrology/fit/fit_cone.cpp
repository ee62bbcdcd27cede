#include <Eigen/Eigenvalues>
#include <array>
#include <numbers>

#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kWording{"cone",
                           "probe at two or more heights and around more of the circumference"};

// Angle and radius for a given axis: the straight line through (along, away) of the points.
Cone start_on(const AxisCandidate& candidate, const NormalisedPoints& few) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(few.points.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Vec3& p : few.points) {
    const Vec3 w = p - candidate.point;
    const double along = w.dot(candidate.axis);
    places.emplace_back(along, (w - along * candidate.axis).norm());
    mean += places.back() / static_cast<double>(few.points.size());
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : places) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  const Eigen::Vector2d generatrix = eigen.eigenvectors().col(1);
  Cone start;
  start.point = candidate.point;
  // Away from the cylinder and the plane, where the angle would have nothing to hold on to.
  start.half_angle =
      std::clamp(std::atan2(std::abs(generatrix.y()), std::abs(generatrix.x())), 0.02, 1.55);
  const bool opens_back = generatrix.x() * generatrix.y() < 0.0;
  start.axis = unit(opens_back ? Vec3(-candidate.axis) : candidate.axis);
  start.radius = mean.y() * std::cos(start.half_angle) -
                 (opens_back ? -mean.x() : mean.x()) * std::sin(start.half_angle);
  return std::get<Cone>(constrained(start, few.constraints));
}

}  // namespace

Result<Fit<Cone>> fit_cone(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::cone, kWording.what, 6}, options);
  if (!local) return std::move(local).error();
  const PrincipalDirections principal = principal_directions(*local);
  if (auto flat = coplanar(*local, principal, kWording.what)) return *flat;
  const PointBlocks all = PointBlocks::of(*local);
  const NormalisedPoints few = thinned(*local, kSearched);
  const AxisSearch search(few, principal);
  const auto start = [&](const AxisCandidate& c) { return start_on(c, few); };
  const auto solve = [&]() -> Result<Minimum> {
    const auto likeliest = starts_from(search.likeliest(RoundKind::cone), start);
    auto direct = at_once(likeliest, *local, all, principal.spread[2]);
    if (direct) return settled(std::move(*direct), all, local->constraints, kWording);
    std::vector<Element> starts;
    for (const RoundKind kind : {RoundKind::cone, RoundKind::cylinder}) {
      const auto more = starts_from(search.candidates(kind, kAxisCandidates), start);
      starts.insert(starts.end(), more.begin(), more.end());
    }
    return best_minimum(starts, *local, all, kWording);
  };
  auto found = solve();
  if (!found) return std::move(found).error();
  const auto& best = std::get<Cone>(found->element);
  constexpr std::array kIsAngle{false, false, true, true, false, true};
  return completed(
      *local, Cone{local->back(best.point), best.axis, best.radius * local->scale, best.half_angle},
      {found->residuals, found->cofactor, kIsAngle, redundancy(*local, *found), found->iterations,
       found->condition});
}

}  // namespace frustum::metrology

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kConeWording{"cone",
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
  const SymmetricEigen eigen = symmetric_eigen(spread);
  const Eigen::Vector2d generatrix = eigen.vectors.col(1);
  Cone start;
  start.point = candidate.point;
  // Away from the cylinder and the plane, where the angle would have nothing to hold on to.
  const double seen = std::atan2(std::abs(generatrix.y()), std::abs(generatrix.x()));
  start.half_angle = few.constraints.half_angle.value_or(std::clamp(seen, 0.02, 1.55));
  const bool opens_back = generatrix.x() * generatrix.y() < 0.0;
  start.axis = unit(opens_back ? Vec3(-candidate.axis) : candidate.axis);
  start.radius = mean.y() * std::cos(start.half_angle) -
                 (opens_back ? -mean.x() : mean.x()) * std::sin(start.half_angle);
  return std::get<Cone>(constrained(start, few.constraints));
}

std::vector<Element> started(const std::vector<AxisCandidate>& candidates,
                             const AxialPoints& points) {
  return starts_from(candidates, [&](const AxisCandidate& c) { return start_on(c, points.few); });
}

std::vector<Element> initial_cones(const AxialPoints& points) {
  return started(points.axes.initial_estimates(RoundKind::cone), points);
}

std::vector<Element> searched_cone(const AxialPoints& points) {
  std::vector<Element> starts;
  for (const RoundKind kind : {RoundKind::cone, RoundKind::cylinder}) {
    const auto more = started(points.axes.candidates(kind, kAxisCandidates), points);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  return starts;
}

Result<Minimum> solve_cone(const NormalisedPoints& local) {
  return axial_minimum(local, kConeWording, initial_cones, searched_cone);
}

Result<Minimum> solve_cone_nearby(const NormalisedPoints& local) {
  auto found = nearby_minimum(local, kConeWording);
  return found ? Result<Minimum>(*std::move(found)) : solve_cone(local);
}

}  // namespace

Result<Fit<Cone>> fit_cone(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Cone>(points, options, {ElementKind::cone, kConeWording.what, 6}, solve_cone);
}

Result<Fit<Cone>> fit_cone_nearby(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Cone>(points, options, {ElementKind::cone, kConeWording.what, 6},
                         solve_cone_nearby);
}

}  // namespace frustum::metrology

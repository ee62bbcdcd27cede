#include <fmt/format.h>

#include <array>
#include <cmath>

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/normalised_points.hpp"
#include "metrology/fit/plane_through.hpp"

namespace frustum::metrology {
namespace {

// The direction of most spread of points seen along `across`, or in space.
Result<UnitVec3> direction_of(NormalisedPoints local, const std::optional<UnitVec3>& across,
                              std::string_view what) {
  if (across) {
    for (Vec3& p : local.points) p -= p.dot(across->vec()) * across->vec();
  }
  const PrincipalDirections principal = principal_directions(local);
  // Two spreads that agree to nine digits: rounding, not the points, would choose the direction.
  if (principal.spread[1] > (1.0 - 1e-9) * principal.spread[0]) {
    return error("degenerate-points"_id,
                 fmt::format("degenerate points for a {}: no direction is distinct", what),
                 fmt::format("a {} needs points that spread along it more than across it", what));
  }
  const Vec3 direction = principal.directions.col(0);
  if (!across) return canonical(direction);
  return canonical(direction - direction.dot(across->vec()) * across->vec());
}

double squares_along(const NormalisedPoints& local, const UnitVec3& axis) {
  double sum = 0.0;
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const double along = local.points[i].dot(axis.vec());
    sum += local.weight(i) * along * along;
  }
  return sum;
}

}  // namespace

Result<Fit<Line>> fit_line(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::line, "line", 4, 2}, options);
  if (!local) return std::move(local).error();
  const Constraints& keep = local->constraints;
  auto axis = keep.parallel_to ? Result<UnitVec3>(canonical(*keep.parallel_to))
                               : direction_of(*local, keep.perpendicular_to, "line");
  if (!axis) return std::move(axis).error();
  const Line in_local{Vec3::Zero(), *axis};
  std::vector<double> residuals;
  residuals.reserve(points.size());
  for (const Vec3& p : local->points) residuals.push_back(residual(in_local, p));
  const double shift = 1.0 / local->all_weights();
  const double tilt = 1.0 / squares_along(*local, *axis);
  const Eigen::Vector4d diagonal(shift, shift, tilt, tilt);
  const StepBasis basis = allowed_steps(in_local, keep);
  // Shifts and tilts at the centroid go separately, toward u as toward v.
  const Eigen::MatrixXd allowed = basis * basis.transpose();
  const Eigen::MatrixXd cofactor =
      allowed.cwiseProduct(diagonal.cwiseSqrt() * diagonal.cwiseSqrt().transpose());
  constexpr std::array kIsAngle{false, false, true, true};
  // A point deviates in two directions from a line.
  const double redundancy =
      2.0 * static_cast<double>(local->count()) - static_cast<double>(basis.cols());
  return completed(*local, Line{local->centre, *axis},
                   {residuals, cofactor, kIsAngle, redundancy, 0, 1.0});
}

Result<Fit<Line>> fit_line_2d(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::line, "line2d", 4, 2}, options);
  if (!local) return std::move(local).error();
  const UnitVec3 plane = coordinate_plane(points);
  const Constraints& keep = local->constraints;
  for (const auto& direction : {keep.parallel_to, keep.perpendicular_to}) {
    if (direction && std::abs(direction->vec().dot(plane.vec())) > 1e-9) {
      return error("constraint-not-applicable"_id,
                   "the direction to keep is not in the plane of the line2d",
                   "a line2d is in the coordinate plane of its points, or in x y");
    }
  }
  auto axis = [&]() -> Result<UnitVec3> {
    if (keep.parallel_to) return canonical(*keep.parallel_to);
    if (keep.perpendicular_to) return canonical(plane.vec().cross(keep.perpendicular_to->vec()));
    return direction_of(*local, plane, "line2d");
  }();
  if (!axis) return std::move(axis).error();
  const Vec3 left = plane.vec().cross(axis->vec());
  std::vector<double> residuals;
  residuals.reserve(points.size());
  for (const Vec3& p : local->points) residuals.push_back(p.dot(left));
  const bool turns = !keep.parallel_to && !keep.perpendicular_to;
  Eigen::MatrixXd cofactor = Eigen::MatrixXd::Zero(2, 2);
  cofactor(0, 0) = 1.0 / local->all_weights();
  if (turns) cofactor(1, 1) = 1.0 / squares_along(*local, *axis);
  constexpr std::array kIsAngle{false, true};
  const double redundancy = static_cast<double>(local->count()) - (turns ? 2.0 : 1.0);
  return completed(*local, Line{local->centre, *axis},
                   {residuals, cofactor, kIsAngle, redundancy, 0, 1.0});
}

}  // namespace frustum::metrology

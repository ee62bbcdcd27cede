#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/normalised_points.hpp"
#include "metrology/fit/plane_through.hpp"

namespace frustum::metrology {
namespace {

// The points seen along a direction that the normal stays perpendicular to.
NormalisedPoints flattened(const NormalisedPoints& local, const Vec3& along) {
  NormalisedPoints flat = local;
  for (Vec3& p : flat.points) p -= p.dot(along) * along;
  return flat;
}

// Two spreads that agree to nine digits: rounding, not the points, would choose the normal.
bool alike(double less, double more) { return less > (1.0 - 1e-9) * more; }

Diagnostic no_plane(std::string_view what) {
  return error("degenerate-points"_id,
               fmt::format("degenerate points for a {}: no plane is distinct", what),
               "the points spread as much across the plane as along it");
}

Diagnostic on_a_line(std::string_view what) {
  return error("degenerate-points"_id,
               fmt::format("degenerate points for a {}: they are on one straight line", what),
               "spread the points over the surface");
}

// Among the normals perpendicular to `along` that of least spread.
Result<UnitVec3> normal_across(const NormalisedPoints& local, const UnitVec3& along,
                               std::string_view what) {
  const PrincipalDirections principal = principal_directions(flattened(local, along));
  if (principal.spread[0] < kFlat) return on_a_line(what);
  if (alike(principal.spread[1], principal.spread[0])) return no_plane(what);
  return canonical(along.vec().cross(principal.directions.col(0)));
}

// From the principal directions, which tell the tilts of slender sets too.
Eigen::MatrixXd free_cofactor(const NormalisedPoints& local, const UnitVec3& normal) {
  const PrincipalDirections principal = principal_directions(local);
  const auto [u, v] = tangents(normal);
  Eigen::MatrixXd cofactor = Eigen::MatrixXd::Zero(3, 3);
  cofactor(0, 0) = 1.0 / local.all_weights();
  for (int k = 0; k < 2; ++k) {
    const Vec3 direction = principal.directions.col(k);
    const Eigen::Vector2d across(direction.dot(u), direction.dot(v));
    const double variance = 1.0 / (local.all_weights() * principal.spread[k] * principal.spread[k]);
    cofactor.bottomRightCorner<2, 2>() += variance * across * across.transpose();
  }
  return cofactor;
}

}  // namespace

Result<UnitVec3> plane_normal(const NormalisedPoints& local, std::string_view what) {
  const Constraints& keep = local.constraints;
  if (keep.axis) return canonical(keep.axis->axis);
  if (keep.parallel_to) return canonical(*keep.parallel_to);
  if (keep.perpendicular_to) return normal_across(local, *keep.perpendicular_to, what);
  const PrincipalDirections principal = principal_directions(local);
  if (principal.spread[1] < kFlat * principal.spread[0]) return on_a_line(what);
  if (alike(principal.spread[2], principal.spread[1])) return no_plane(what);
  return canonical(principal.directions.col(2));
}

UnitVec3 coordinate_plane(std::span<const Vec3> points) {
  for (const UnitVec3& axis : {UnitVec3::z(), UnitVec3::y(), UnitVec3::x()}) {
    const bool constant = std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      return p.dot(axis.vec()) == points.front().dot(axis.vec());
    });
    if (constant) return axis;
  }
  return UnitVec3::z();
}

Result<Fit<Plane>> fit_plane(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::plane, "plane", 3}, options);
  if (!local) return std::move(local).error();
  auto normal = plane_normal(*local, "plane");
  if (!normal) return std::move(normal).error();
  const auto [u, v] = tangents(*normal);
  std::vector<double> residuals;
  residuals.reserve(points.size());
  Mat3 information = Mat3::Zero();
  for (std::size_t i = 0; i < local->points.size(); ++i) {
    const Vec3& p = local->points[i];
    residuals.push_back(p.dot(normal->vec()));
    const Vec3 row(-1.0, p.dot(u), p.dot(v));
    information += local->weight(i) * row * row.transpose();
  }
  const StepBasis basis = allowed_steps(Plane{Vec3::Zero(), *normal}, local->constraints);
  const Eigen::MatrixXd free = basis.transpose() * information * basis;
  const Eigen::MatrixXd cofactor =
      free.rows() == 3 ? free_cofactor(*local, *normal)
                       : Eigen::MatrixXd(basis * free.inverse() * basis.transpose());
  constexpr std::array kIsAngle{false, true, true};
  const double redundancy = static_cast<double>(local->count()) - static_cast<double>(free.rows());
  return completed(*local, Plane{local->centre, *normal},
                   {residuals, cofactor, kIsAngle, redundancy, 0, condition_of(free)});
}

}  // namespace frustum::metrology

#include <fmt/format.h>

#include <array>

#include "metrology/gauss_newton.hpp"
#include "metrology/least_squares.hpp"
#include "metrology/normalised_points.hpp"

namespace frustum::metrology {
namespace {

struct SphereModel {
  static constexpr int kParameters = 4;
  Vec3 centre = Vec3::Zero();
  double radius = 1.0;

  void linearise(std::span<const Vec3> points, Linearised<4>& out) const {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Vec3 w = points[k] - centre;
      const double away = w.norm();
      const Vec3 e = away > 0.0 ? Vec3(w / away) : Vec3(Vec3::UnitX());
      out.residuals[i] = away - radius;
      out.jacobian.row(i) << -e.transpose(), -1.0;
    }
  }
  [[nodiscard]] SphereModel moved(const Eigen::Vector4d& step) const {
    return {centre + step.head<3>(), radius + step[3]};
  }
};

// Algebraic sphere: linear in centre and radius^2 - centre^2.
SphereModel algebraic_sphere(const std::vector<Vec3>& points) {
  Eigen::MatrixX4d rows(static_cast<Eigen::Index>(points.size()), 4);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    rows.row(i) << 2.0 * points[k].transpose(), 1.0;
    right[i] = points[k].squaredNorm();
  }
  const Eigen::Vector4d s = rows.colPivHouseholderQr().solve(right);
  return {s.head<3>(), std::sqrt(std::max(s[3] + s.head<3>().squaredNorm(), 0.0))};
}

}  // namespace

Result<Fit<Sphere>> fit_sphere(std::span<const Vec3> points) {
  auto local = normalise(points, "sphere", 4);
  if (!local) return std::move(local).error();
  const PrincipalDirections principal = principal_directions(*local);
  if (principal.spread[2] < kFlat * principal.spread[0]) {
    return error("degenerate points for a sphere: they lie in one plane",
                 "probe the sphere also away from that plane");
  }
  GaussNewton<SphereModel> solver(algebraic_sphere(local->points), local->points);
  solver.descend(100);
  const Minimum<SphereModel> found = solver.settle();
  if (!found.well_posed) {
    return error("degenerate points for a sphere: they do not tell centre and radius",
                 "probe a larger part of the sphere");
  }
  if (!found.converged) {
    return error(fmt::format("the sphere fit did not converge in {} steps", found.iterations),
                 "check that the points lie near a sphere");
  }
  constexpr std::array kIsAngle{false, false, false, false};
  return completed(*local,
                   Sphere{local->back(found.model.centre), found.model.radius * local->scale},
                   found.residuals, found.cofactor, kIsAngle,
                   static_cast<double>(points.size()) - 4.0, found.iterations);
}

}  // namespace frustum::metrology

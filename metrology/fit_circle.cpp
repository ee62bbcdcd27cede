#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "metrology/gauss_newton.hpp"
#include "metrology/least_squares.hpp"
#include "metrology/plane_through.hpp"

namespace frustum::metrology {
namespace {

// In the x-y plane: z of the points does not count.
struct CircleModel {
  static constexpr int kParameters = 3;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 1.0;

  void linearise(std::span<const Vec3> points, Linearised<3>& out) const {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Eigen::Vector2d w = points[k].head<2>() - centre;
      const double away = w.norm();
      const Eigen::Vector2d e = away > 0.0 ? Eigen::Vector2d(w / away) : Eigen::Vector2d::UnitX();
      out.residuals[i] = away - radius;
      out.jacobian.row(i) << -e.transpose(), -1.0;
    }
  }
  [[nodiscard]] CircleModel moved(const Eigen::Vector3d& step) const {
    return {centre + step.head<2>(), radius + step[2]};
  }
};

// Algebraic circle: linear in centre and radius^2 - centre^2.
CircleModel algebraic_circle(const std::vector<Vec3>& points) {
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    rows.row(i) << 2.0 * points[k].x(), 2.0 * points[k].y(), 1.0;
    right[i] = points[k].head<2>().squaredNorm();
  }
  const Eigen::Vector3d s = rows.colPivHouseholderQr().solve(right);
  return {s.head<2>(), std::sqrt(std::max(s[2] + s.head<2>().squaredNorm(), 0.0))};
}

Result<Fit<Circle>> circle_in(const NormalisedPoints& local, const UnitVec3& normal) {
  // Rotates the plane's normal to z; the frame's own third direction is dropped.
  const auto [u, v] = tangents(normal);
  std::vector<Vec3> flat;
  Mat3 information = Mat3::Zero();
  double squares = 0.0;
  for (const Vec3& p : local.points) {
    flat.emplace_back(p.dot(u), p.dot(v), 0.0);
    const Vec3 row(1.0, p.dot(u), p.dot(v));
    information += row * row.transpose();
    squares += p.dot(normal.vec()) * p.dot(normal.vec());
  }
  const CircleModel start = algebraic_circle(flat);
  GaussNewton<CircleModel> solver(start, flat);
  solver.descend(100);
  const Minimum<CircleModel> found = solver.settle();
  if (!found.well_posed) {
    return error("degenerate points for a circle: they lie on one straight line",
                 "a circle needs three points that differ in direction");
  }
  if (!found.converged) {
    return error(fmt::format("the circle fit did not converge in {} steps", found.iterations),
                 "check that the points lie near a circle");
  }
  Eigen::MatrixXd cofactor = Eigen::MatrixXd::Zero(6, 6);
  cofactor.topLeftCorner<3, 3>() = found.cofactor;
  cofactor.bottomRightCorner<3, 3>() = information.inverse();
  constexpr std::array kIsAngle{false, false, false, false, true, true};
  const double redundancy = static_cast<double>(flat.size()) - 3.0;
  const Circle circle{local.back(found.model.centre.x() * u + found.model.centre.y() * v), normal,
                      found.model.radius * local.scale};
  Fit<Circle> fit =
      completed(local, circle, found.residuals, cofactor, kIsAngle, redundancy, found.iterations);
  // The plane has its own scatter.
  const double plane_variance =
      redundancy > 0.0 ? squares * local.scale * local.scale / redundancy : 0.0;
  fit.covariance.bottomRightCorner<3, 3>() =
      fit.cofactor.bottomRightCorner<3, 3>() * plane_variance;
  return fit;
}

}  // namespace

Result<Fit<Circle>> fit_circle(std::span<const Vec3> points) {
  auto local = normalise(points, "circle", 3);
  if (!local) return std::move(local).error();
  auto normal = plane_normal(*local, "circle");
  if (!normal) return std::move(normal).error();
  return circle_in(*local, *normal);
}

Result<Fit<Circle>> fit_circle_2d(std::span<const Vec3> points) {
  auto local = normalise(points, "circle", 3);
  if (!local) return std::move(local).error();
  for (const UnitVec3& axis : {UnitVec3::z(), UnitVec3::y(), UnitVec3::x()}) {
    const bool constant = std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      return p.dot(axis.vec()) == points.front().dot(axis.vec());
    });
    if (constant) return circle_in(*local, axis);
  }
  return circle_in(*local, UnitVec3::z());
}

}  // namespace frustum::metrology

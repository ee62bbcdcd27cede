#include <array>

#include "metrology/least_squares.hpp"
#include "metrology/normalised_points.hpp"

namespace frustum::metrology {

Result<Fit<Line>> fit_line(std::span<const Vec3> points) {
  auto local = normalise(points, "line", 2);
  if (!local) return std::move(local).error();
  const PrincipalDirections principal = principal_directions(*local);
  // Two spreads that agree to nine digits: rounding, not the points, would choose the direction.
  if (principal.spread[1] > (1.0 - 1e-9) * principal.spread[0]) {
    return error("degenerate points for a line: no direction stands out",
                 "a line needs points that spread along it more than across it");
  }
  const Line in_local{Vec3::Zero(), canonical(principal.directions.col(0))};
  std::vector<double> residuals;
  double squares_along = 0.0;
  for (const Vec3& p : local->points) {
    residuals.push_back(residual(in_local, p));
    squares_along += p.dot(in_local.axis.vec()) * p.dot(in_local.axis.vec());
  }
  const auto n = static_cast<double>(points.size());
  Eigen::MatrixXd cofactor = Eigen::MatrixXd::Zero(4, 4);
  cofactor.diagonal() << 1.0 / n, 1.0 / n, 1.0 / squares_along, 1.0 / squares_along;
  constexpr std::array kIsAngle{false, false, true, true};
  // A point deviates in two directions from a line.
  return completed(*local, Line{local->centre, in_local.axis}, residuals, cofactor, kIsAngle,
                   2.0 * n - 4.0, 0);
}

}  // namespace frustum::metrology

#include "metrology/characteristic/harmonics.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {

Result<std::vector<Harmonic>> harmonics(std::span<const double> angle,
                                        std::span<const double> deviation, int highest) {
  const auto rows = static_cast<Eigen::Index>(angle.size());
  const Eigen::Index columns = 2 * highest + 1;
  if (rows < columns) {
    return error("too-few-points"_id,
                 fmt::format("{} undulations per revolution need {} points, given are {}", highest,
                             columns, rows),
                 "measure more points, or ask for fewer harmonics");
  }
  Eigen::MatrixXd waves(rows, columns);
  Eigen::VectorXd profile(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double turn = angle[static_cast<std::size_t>(i)];
    profile[i] = deviation[static_cast<std::size_t>(i)];
    waves(i, 0) = std::numbers::sqrt2 / 2.0;  // as long a column as the others
    for (int k = 1; k <= highest; ++k) {
      waves(i, 2 * k - 1) = std::cos(k * turn);
      waves(i, 2 * k) = std::sin(k * turn);
    }
  }
  const SymmetricFactors normal(waves.transpose() * waves);
  const Eigen::VectorXd pivots = normal.pivots().cwiseAbs();
  // The normal matrix is n/2 times the identity for equal steps; 1e-8 of it leaves half the digits.
  if (!(pivots.minCoeff() > 1e-8 * pivots.maxCoeff())) {
    return error("harmonics-undetermined"_id,
                 fmt::format("the points leave gaps in which {} undulations per revolution cannot "
                             "be separated",
                             highest),
                 "measure the whole turn, or ask for fewer harmonics");
  }
  Eigen::VectorXd x = normal.solve(Eigen::VectorXd(waves.transpose() * profile));
  x += normal.solve(
      Eigen::VectorXd(waves.transpose() * (profile - waves * x)));  // restores the digits lost
  std::vector<Harmonic> found;
  for (int k = 1; k <= highest; ++k) {
    const double c = x[2 * k - 1];
    const double s = x[2 * k];
    found.push_back({k, std::hypot(c, s), std::atan2(s, c)});
  }
  return found;
}

}  // namespace frustum::metrology

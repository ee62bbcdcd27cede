#include "instruments/line_straightness.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "metrology/fit/minimax/linear_minimax.hpp"

namespace frustum::instruments {
namespace {

// Of the deviations less slope times position.
double range_without(double slope, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd left = y - slope * x;
  return left.maxCoeff() - left.minCoeff();
}

}  // namespace

Result<Straightness> straightness_of(std::span<const double> position,
                                     std::span<const double> deviation) {
  if (position.size() < 3) {
    return error("too-few-targets"_id,
                 fmt::format("straightness needs three positions, given are {}", position.size()));
  }
  const auto count = static_cast<Eigen::Index>(position.size());
  // Along the line from -1 to 1.
  const double middle = 0.5 * (position.front() + position.back());
  const double half = 0.5 * (position.back() - position.front());
  Eigen::VectorXd x(count), y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x[i] = (position[static_cast<std::size_t>(i)] - middle) / half;
    y[i] = deviation[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd about = x.array() - x.mean();
  const double slope = about.dot(y) / about.squaredNorm();
  Straightness found{.least_squares = range_without(slope, x, y),
                     .end_points = range_without(0.5 * (y[count - 1] - y[0]), x, y)};
  found.minimum_zone = found.least_squares;
  // Below this share of the deviations what is left is rounding, whose zone is what it is.
  if (found.least_squares <= 1e-12 * y.cwiseAbs().maxCoeff()) return found;
  const double scale = found.least_squares;
  const Eigen::VectorXd values = (y - slope * x).array() / scale - y.mean() / scale;
  metrology::Gradients gradients(count, 2);
  gradients.col(0).setConstant(-1.0);
  gradients.col(1) = -x;
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(2, 1e3);
  const auto zone = metrology::linear_minimax(values, gradients, metrology::Sides{}, reach);
  if (!zone.solved) return error("not-converged"_id, "no minimum zone was found for the line");
  found.minimum_zone = 2.0 * zone.level * scale;
  return found;
}

}  // namespace frustum::instruments

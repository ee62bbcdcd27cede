#include "studies/linear_model.hpp"

#include "core/linear_algebra.hpp"

namespace frustum::studies {

Eigen::MatrixXd centred(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& motions) {
  const Eigen::MatrixXd basis = orthonormal_columns(motions);
  // Twice: what rounding left of the motions in the first remainder goes, too.
  Eigen::MatrixXd rest = columns - basis * (basis.transpose() * columns);
  rest -= basis * (basis.transpose() * rest);
  return rest;
}

Eigen::MatrixXd circle_motions(const Eigen::VectorXd& angles) {
  Eigen::MatrixXd motions(angles.size(), 3);
  motions.col(0).setOnes();
  motions.col(1) = angles.array().cos();
  motions.col(2) = angles.array().sin();
  return motions;
}

double value_of(const LinearCharacteristic& characteristic, const Eigen::VectorXd& weights) {
  if (const auto* sum = std::get_if<LinearSum>(&characteristic.of))
    return sum->constant + sum->gains.dot(weights);
  const auto& range = std::get<LinearRange>(characteristic.of);
  const Eigen::VectorXd moved = range.nominal + range.gains * weights;
  return moved.maxCoeff() - moved.minCoeff();
}

}  // namespace frustum::studies

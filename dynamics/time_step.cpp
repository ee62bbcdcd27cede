#include "dynamics/time_step.hpp"

#include <Eigen/LU>

#include "core/general_algebra.hpp"

namespace frustum::dynamics {

using Eigen::MatrixXd;

TimeStep::TimeStep(const MatrixXd& matrix, double seconds)
    : transition_(matrix_exponential(matrix * seconds)) {
  const MatrixXd one = MatrixXd::Identity(matrix.rows(), matrix.cols());
  const Eigen::PartialPivLU<MatrixXd> factors(matrix);
  // The integral of exp(A t) over the step, and its mean over the step.
  const MatrixXd whole = factors.solve(transition_ - one);
  after_ = factors.solve(whole / seconds - one);
  before_ = whole - after_;
}

}  // namespace frustum::dynamics

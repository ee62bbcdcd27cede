#include "dynamics/time_step.hpp"

#include <Eigen/LU>

#include "core/general_algebra.hpp"

namespace frustum::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TimeStep::TimeStep(const MatrixXd& matrix, double seconds)
    : transition_(matrix_exponential(matrix * seconds)) {
  const MatrixXd one = MatrixXd::Identity(matrix.rows(), matrix.cols());
  const Eigen::PartialPivLU<MatrixXd> factors(matrix);
  // The integral of exp(A t) over the step, and its mean over the step.
  const MatrixXd whole = factors.solve(transition_ - one);
  after_ = factors.solve(whole / seconds - one);
  before_ = whole - after_;
}

SeriesStep::SeriesStep(const MatrixXd& matrix, Eigen::Index positions, double seconds)
    : positions_(positions),
      seconds_(seconds),
      rate_(seconds * matrix(0, positions)),
      below_(seconds * matrix.bottomRows(matrix.rows() - positions)) {}

void SeriesStep::change(const VectorXd& state, VectorXd& rate) const {
  rate.head(positions_) = rate_ * state.segment(positions_, positions_);
  rate.tail(below_.rows()).noalias() = below_ * state;
}

VectorXd SeriesStep::operator()(const VectorXd& state, const VectorXd& input_before,
                                const VectorXd& input_after) const {
  // Terms h^k / k! y(k).
  VectorXd term(state.size()), next(state.size());
  change(state, term);
  term += seconds_ * input_before;
  VectorXd sum = state + term;
  change(term, next);
  next += seconds_ * (input_after - input_before);
  next *= 0.5;
  constexpr int kMostTerms = 200;      // of a step of many periods, whose terms first grow
  constexpr double kRounding = 1e-17;  // of the sum
  for (int k = 3; k < kMostTerms; ++k) {
    sum += next;
    if (next.lpNorm<Eigen::Infinity>() <= kRounding * sum.lpNorm<Eigen::Infinity>()) break;
    term.swap(next);
    change(term, next);
    next /= k;
  }
  return sum;
}

}  // namespace frustum::dynamics

#include "metrology/fit/gauss_newton.hpp"

#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {
namespace {

// Normal equations square the condition: beyond this their steps have fewer than eight digits.
constexpr double kGoodCondition = 1e4;

}  // namespace

GaussNewton::GaussNewton(const Element& start, const PointBlocks& points,
                         const Constraints& constraints)
    : points_(&points), constraints_(&constraints), bound_(constraints.any()), element_(start) {
  accept(start, gram_of(start, points));
}

void GaussNewton::descend(int most, double least_gain) {
  double damping = 1e-3;
  for (int i = 0; i < most && std::isfinite(cost()) && right_.size() > 0; ++i) {
    const Element trial = moved_by(step(damping));
    const ElementGram there = gram_of(trial, *points_);
    ++iterations_;
    if (cost_of(there) < cost()) {
      const double gain = (cost() - cost_of(there)) / cost();
      accept(trial, there);
      damping *= 0.1;
      if (gain < least_gain) return;
    } else {
      damping = 10.0 * std::max(damping, 1e-6);
      // The direction of steepest descent alone, shortened a billionfold, finds nothing lower.
      if (damping > 1e9) return;
    }
  }
}

Minimum GaussNewton::settle() {
  Minimum result;
  result.condition = condition();
  result.well_posed = true;
  const bool by_factors = !(result.condition < kGoodCondition);
  const bool bent = may_bend_down(result.condition);
  const Element start = element_;
  // Steps by factors keep digits that second derivatives do not have: they go first.
  if (by_factors || !bent) {
    result.converged = converged_by_full_steps(by_factors);
  }
  if (!result.converged || (by_factors && bent && bends_down())) {
    const Element astray = element_;
    if (!result.converged) accept(start, gram_of(start, *points_));
    settle_by_bend(result);
    // What the points do not tell shows where full steps ran to.
    if (by_factors && !result.converged) accept(astray, gram_of(astray, *points_));
    result.condition = condition();
  }
  report(result);
  return result;
}

bool GaussNewton::converged_by_full_steps(bool by_factors) {
  double previous = std::numeric_limits<double>::infinity();
  // Large residuals make convergence linear: 300 steps of rate 0.9. Newton's steps take over
  // sooner.
  const int most = by_factors ? 300 : 40;
  for (int i = 0; i < most && std::isfinite(cost()); ++i) {
    const ElementStep full = by_factors ? step_by_factors() : step(0.0);
    const double length = full.norm();
    if (!std::isfinite(length)) return false;
    // 1e-10 of the part is what the fits promise; steps that small which stop shrinking are
    // rounding.
    if (length < 1e-15 || (length < 1e-10 && length > 0.7 * previous)) return true;
    const Element trial = moved_by(full);
    accept(trial, gram_of(trial, *points_));
    ++iterations_;
    // Steps shrink by a constant factor: the next one would be rounding.
    if (length < 1e-9 && std::isfinite(previous) && length * (length / previous) < 1e-16)
      return true;
    previous = length;
  }
  return false;
}

Element GaussNewton::moved_by(const ElementStep& free) const {
  const ElementStep all = bound_ ? ElementStep(basis_ * free) : free;
  return shifted(moved(element_, all), Vec3::Zero());
}

void GaussNewton::accept(const Element& element, const ElementGram& gram) {
  element_ = element;
  gram_ = gram;
  reduce();
}

void GaussNewton::reduce() {
  const Eigen::Index n = gram_.rows() - 1;
  normal_ = gram_.topLeftCorner(n, n).selfadjointView<Eigen::Lower>();
  right_ = -gram_.row(n).head(n).transpose();
  if (bound_) {
    basis_ = allowed_steps(element_, *constraints_);
    normal_ = Square(basis_.transpose() * normal_ * basis_);
    right_ = ElementStep(basis_.transpose() * right_);
  }
  length_ = normal_.diagonal().cwiseSqrt();
  for (double& length : length_) length = length > 0.0 ? length : 1.0;
  for (Eigen::Index i = 0; i < normal_.rows(); ++i) {
    for (Eigen::Index j = 0; j < normal_.cols(); ++j) normal_(i, j) /= length_[i] * length_[j];
  }
  right_ = right_.cwiseQuotient(length_);
}

ElementStep GaussNewton::step(double damping) const {
  Square damped = normal_;
  damped.diagonal().array() += damping;
  const ElementStep scaled = SymmetricFactors(damped).solve(Eigen::VectorXd(right_));
  return scaled.cwiseQuotient(length_);
}

// The Jacobian by the scaled free parameters, and the residuals in a last column.
Eigen::MatrixXd GaussNewton::rows() const {
  const Eigen::Index n = right_.size();
  Eigen::MatrixXd all(static_cast<Eigen::Index>(points_->count), n + 1);
  for (std::size_t k = 0; k < points_->count; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const LinearisedPoint one = linearised(element_, points_->point(k));
    const ElementStep gradient =
        bound_ ? ElementStep(basis_.transpose() * one.gradient) : one.gradient;
    all.row(i).head(n) = gradient.cwiseQuotient(length_).transpose();
    all(i, n) = one.residual;
    all.row(i) *= points_->root_weight_of(k);
  }
  return all;
}

ElementStep GaussNewton::step_by_factors() const {
  const Eigen::MatrixXd all = rows();
  const Eigen::Index n = right_.size();
  const ElementStep scaled = least_squares_solution(all.leftCols(n), -all.col(n));
  return scaled.cwiseQuotient(length_);
}

double GaussNewton::condition() const {
  if (right_.size() == 0 || !std::isfinite(cost())) return 1.0;
  const Eigen::VectorXd values = symmetric_eigenvalues(normal_);
  return std::sqrt(values[right_.size() - 1] / std::max(values[0], 1e-300));
}

// R with R R^T the cofactor of the scaled free parameters; says whether there is one.
GaussNewton::Square GaussNewton::root_of_cofactor(Minimum& result) const {
  const Eigen::Index n = right_.size();
  if (result.condition < kGoodCondition) {
    result.well_posed = true;
    return lower_inverse(lower_root(normal_)).transpose();
  }
  const Eigen::MatrixXd all = rows();
  const SingularValues svd = singular_values(all.leftCols(n), SingularVectors::thin);
  const Eigen::VectorXd& values = svd.values;
  // With a ratio of 1e-9 rounding in the coordinates moves the weakest parameter by a ten millionth
  // of the part: the points do not tell it.
  result.well_posed = svd.converged && values.size() == n && values[n - 1] > 1e-9 * values[0];
  if (!result.well_posed) return Square::Zero(n, n);
  result.condition = values[0] / values[n - 1];
  return svd.right * values.cwiseInverse().asDiagonal();
}

void GaussNewton::report(Minimum& result) const {
  result.element = element_;
  result.iterations = iterations_;
  result.free_parameters = static_cast<int>(right_.size());
  result.residuals.reserve(points_->count);
  for (std::size_t k = 0; k < points_->count; ++k) {
    result.residuals.push_back(residual(element_, points_->point(k)));
  }
  const Eigen::Index parameters = gram_.rows() - 1;
  result.cofactor = Eigen::MatrixXd::Zero(parameters, parameters);
  result.well_posed = result.well_posed && std::isfinite(cost());
  if (!result.well_posed || right_.size() == 0) return;
  const Square scaled = root_of_cofactor(result);
  Eigen::MatrixXd root = length_.cwiseInverse().asDiagonal() * scaled;
  if (bound_) root = Eigen::MatrixXd(basis_ * root);
  result.cofactor = root * root.transpose();
}

}  // namespace frustum::metrology

// Where residuals are large: minima told from saddles by the second derivatives.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"
#include "metrology/fit/curvature.hpp"
#include "metrology/fit/gauss_newton.hpp"

namespace frustum::metrology {
namespace {

// Valleys that bend up by less than a millionth of what the Jacobian promises, which is 1, are
// flat: a residual changed by a millionth moves the minimum by as much as the part.
constexpr double kLevel = 1e-6;

}  // namespace

// Full steps are attracted by minima alone, but a start that is as symmetric as its points may sit
// on a saddle. There the residuals are as large as the bow of the points by which they tell the
// parameters.
bool GaussNewton::may_bend_down(double condition) const {
  const double mean_square = cost() / static_cast<double>(points_->count);
  return right_.size() > 0 && std::sqrt(mean_square) * condition > 0.1;
}

// Beyond doubt: of points that hardly tell a parameter, differences tell a hundredth of the bend.
bool GaussNewton::bends_down() const { return !(bend().curvature[0] > -0.1); }

GaussNewton::Bend GaussNewton::bend() const {
  const Eigen::Index n = right_.size();
  const Square inverse_length = length_.cwiseInverse().asDiagonal();
  const StepBasis basis = bound_ ? basis_ : StepBasis(StepBasis::Identity(n, n));
  const Square second = inverse_length * curvature_of(element_, *points_, basis) * inverse_length;
  Square normal = normal_;
  normal.diagonal().array() += 1e-8;  // for points that do not tell a parameter
  const Square inverse_root = lower_inverse(lower_root(normal));
  const Square full = inverse_root * second * inverse_root.transpose();
  const SymmetricEigen eigen = symmetric_eigen(0.5 * (full + full.transpose()));
  Bend bend;
  bend.frame = inverse_length * Square(inverse_root.transpose() * eigen.vectors);
  bend.curvature = eigen.values;
  bend.downhill = eigen.vectors.transpose() * ElementStep(inverse_root * right_);
  return bend;
}

bool GaussNewton::lowered_by(const ElementStep& step) {
  for (double part = 1.0; part > 1e-6; part *= 0.5) {
    const Element trial = moved_by(part * step);
    const ElementGram there = gram_of(trial, *points_);
    ++iterations_;
    if (cost_of(there) < cost()) {
      accept(trial, there);
      return true;
    }
  }
  return false;
}

// From a saddle or a maximum to either side.
bool GaussNewton::left_along(const ElementStep& direction) {
  for (double by = 0.5; by > 1e-4; by *= 0.5) {
    for (const double signed_by : {by, -by}) {
      const Element trial = moved_by(signed_by * direction.normalized());
      const ElementGram there = gram_of(trial, *points_);
      ++iterations_;
      // Less is the rounding of a level valley.
      if (cost_of(there) < cost() * (1.0 - 1e-9)) {
        accept(trial, there);
        return true;
      }
    }
  }
  return false;
}

void GaussNewton::settle_by_bend(Minimum& result) {
  result.converged = false;
  double previous = std::numeric_limits<double>::infinity();
  constexpr int kMost = 100;
  for (int i = 0; i < kMost && std::isfinite(cost()); ++i) {
    const Bend bend = this->bend();
    const double least = bend.curvature[0];
    if (!bend.curvature.allFinite()) return;
    const bool hollow = least > kLevel;
    const ElementStep bends =
        hollow ? bend.curvature : ElementStep(bend.curvature.cwiseAbs().cwiseMax(1e-3));
    const ElementStep full = bend.frame * bend.downhill.cwiseQuotient(bends);
    const double length = full.norm();
    if (!std::isfinite(length)) return;
    // 1e-10 of the part is what the fits promise; a weak bend makes more of the rounding of
    // gradients.
    const ElementStep weakness =
        bend.frame.colwise().squaredNorm().transpose().cwiseQuotient(bends);
    const double rounding =
        std::clamp(2e-16 * static_cast<double>(points_->count) * weakness.maxCoeff(), 1e-10, 1e-8);
    if (hollow && (length < 1e-15 || (length < rounding && length > 0.7 * previous))) {
      result.converged = true;
      return;
    }
    previous = length;
    // So near that the sum of squares hardly tells: the gradient does.
    if (hollow && length < 1e-5) {
      const Element trial = moved_by(full);
      accept(trial, gram_of(trial, *points_));
      ++iterations_;
    } else if (length < 1e-7 || !lowered_by(full)) {
      if (hollow) return;
      if (!left_along(bend.frame.col(0))) {
        result.converged = true;
        result.well_posed = false;
        return;
      }
    }
  }
}

}  // namespace frustum::metrology

// Levenberg-Marquardt descent, then Gauss-Newton steps down to rounding.
//
// Model    : minimise |d(m)|^2 over a model m that is moved by steps of N local parameters
// Units    : local frame of size one (normalised_points.hpp), rad
// Shape    : n >= N residuals
// Errors   : Minimum::converged and Minimum::well_posed tell; the caller words the diagnostic
// Accuracy : the last step is below 1e-10 of the size of the part, typically 1e-15
// Source   : Nocedal, Wright, Numerical Optimization, sections 10.2 and 10.3
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum::metrology {

template <int N>
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::Matrix<double, Eigen::Dynamic, N> jacobian;
};

template <typename Model>
struct Minimum {
  Model model;
  double cost = 0.0;
  std::vector<double> residuals{};
  Eigen::MatrixXd cofactor{};
  int iterations = 0;
  bool converged = false;
  bool well_posed = false;  // the points tell every parameter
};

// Model provides: static constexpr int kParameters; void linearise(span, Linearised&) const;
// Model moved(const Vector<N>&) const.
template <typename Model>
class GaussNewton {
 public:
  static constexpr int kN = Model::kParameters;
  using Step = Eigen::Matrix<double, kN, 1>;

  GaussNewton(Model start, std::span<const Vec3> points)
      : points_(points), model_(std::move(start)) {
    resize(now_);
    resize(next_);
    model_.linearise(points_, now_);
    cost_ = now_.residuals.squaredNorm();
  }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] double cost() const { return cost_; }

  // Steps that lower the cost, at most `most`; stops when they hardly do.
  void descend(int most) {
    double damping = 1e-3;
    for (int i = 0; i < most && std::isfinite(cost_); ++i) {
      factorise();
      const Model trial = model_.moved(step(damping));
      trial.linearise(points_, next_);
      const double trial_cost = next_.residuals.squaredNorm();
      ++iterations_;
      if (trial_cost < cost_) {
        const double gain = (cost_ - trial_cost) / cost_;
        accept(trial, trial_cost);
        damping *= 0.1;
        // Below this gain the cost no longer tells good steps from bad ones; settle() takes over.
        if (gain < 1e-8) return;
      } else {
        damping = 10.0 * std::max(damping, 1e-6);
        // The direction of steepest descent alone, shortened a billionfold, finds nothing lower.
        if (damping > 1e9) return;
      }
    }
  }

  // Full steps until they no longer shrink.
  [[nodiscard]] Minimum<Model> settle() {
    double previous = std::numeric_limits<double>::infinity();
    bool converged = false;
    constexpr int kMost = 300;  // large residuals make convergence linear: 300 steps of rate 0.9
    for (int i = 0; i < kMost && std::isfinite(cost_); ++i) {
      factorise();
      const Step full = step(0.0);
      const double length = full.norm();
      if (!std::isfinite(length)) break;
      // 1e-10 of the part is what the fits promise; steps that small which stop shrinking are
      // rounding.
      if (length < 1e-10 && length > 0.7 * previous) converged = true;
      if (length < 1e-15) converged = true;
      if (converged) break;
      const Model trial = model_.moved(full);
      trial.linearise(points_, next_);
      accept(trial, next_.residuals.squaredNorm());
      ++iterations_;
      previous = length;
    }
    return report(converged);
  }

 private:
  void resize(Linearised<kN>& l) const {
    const auto n = static_cast<Eigen::Index>(points_.size());
    l.residuals.resize(n);
    l.jacobian.resize(n, kN);
  }

  void accept(const Model& model, double cost) {
    model_ = model;
    cost_ = cost;
    std::swap(now_, next_);
  }

  // QR of the Jacobian with columns of length one.
  void factorise() {
    for (int j = 0; j < kN; ++j) {
      const double length = now_.jacobian.col(j).norm();
      column_[j] = length > 0.0 ? length : 1.0;
    }
    next_.jacobian = now_.jacobian * column_.cwiseInverse().asDiagonal();
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, kN>>> qr(
        next_.jacobian);
    triangle_ = qr.matrixQR().template topRows<kN>().template triangularView<Eigen::Upper>();
    next_.residuals = now_.residuals;
    next_.residuals.applyOnTheLeft(qr.householderQ().adjoint());
    rotated_ = next_.residuals.template head<kN>();
  }

  [[nodiscard]] Step step(double damping) const {
    Eigen::Matrix<double, 2 * kN, kN> rows;
    rows << triangle_, std::sqrt(damping) * Eigen::Matrix<double, kN, kN>::Identity();
    Eigen::Matrix<double, 2 * kN, 1> right;
    right << -rotated_, Step::Zero();
    return rows.colPivHouseholderQr().solve(right).cwiseQuotient(column_);
  }

  [[nodiscard]] Minimum<Model> report(bool converged) {
    Minimum<Model> result{model_, cost_};
    result.iterations = iterations_;
    result.converged = converged;
    result.residuals.assign(now_.residuals.data(), now_.residuals.data() + now_.residuals.size());
    factorise();
    const Eigen::JacobiSVD<Eigen::Matrix<double, kN, kN>> svd(
        triangle_, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.info() != Eigen::Success) return result;  // the steps left the numbers
    const Step& values = svd.singularValues();
    // With a ratio of 1e-9 rounding in the coordinates moves the weakest parameter by a ten
    // millionth of the part: the points do not tell it.
    result.well_posed = std::isfinite(cost_) && values[kN - 1] > 1e-9 * values[0];
    if (result.well_posed) {
      const Eigen::Matrix<double, kN, kN> root =
          column_.cwiseInverse().asDiagonal() * svd.matrixV() * values.cwiseInverse().asDiagonal();
      result.cofactor = root * root.transpose();
    }
    return result;
  }

  std::span<const Vec3> points_;
  Model model_;
  double cost_ = 0.0;
  int iterations_ = 0;
  Linearised<kN> now_{};
  Linearised<kN> next_{};
  Step column_ = Step::Ones();
  Step rotated_ = Step::Zero();
  Eigen::Matrix<double, kN, kN> triangle_ = Eigen::Matrix<double, kN, kN>::Identity();
};

}  // namespace frustum::metrology

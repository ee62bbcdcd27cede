#include "studies/statistics/normal_length.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/linear_algebra.hpp"
#include "studies/laws/law.hpp"
#include "studies/laws/quadrature.hpp"

namespace frustum::studies {
namespace {

constexpr double kLengthReach = 9.0;  // standard deviations: 1e-19 of a normal law is beyond
constexpr int kLengthNodes = 96;
// A spread below this share of the largest one is none: it changes |E| by less than 1e-9 of it.
constexpr double kNoSpread = 1e-9;

double density_at(double x, double mean, double sd) {
  const double z = (x - mean) / sd;
  return std::exp(-0.5 * z * z) / (sd * std::sqrt(2.0 * std::numbers::pi));
}

// P(|x| <= reach) of one component.
double within_reach(double reach, double mean, double sd) {
  const double a = (-reach - mean) / sd, b = (reach - mean) / sd;
  return a > 0.0 ? normal_probability(-a) - normal_probability(-b)
                 : normal_probability(b) - normal_probability(a);
}

// The integral over a component's density of f(r^2 - x^2), where that is above 0.
template <typename F>
double over_component(const Quadrature& rule, double square, double mean, double sd, const F& f) {
  if (sd == 0.0) return square > mean * mean ? f(square - mean * mean) : 0.0;
  const double r = std::sqrt(square);
  const double lo = std::max(-r, mean - kLengthReach * sd),
               hi = std::min(r, mean + kLengthReach * sd);
  if (!(lo < hi)) return 0.0;
  double sum = 0.0;
  for (const QuadratureNode& node : over_with_roots(rule, lo, hi)) {
    const double left = square - node.x * node.x;
    if (left > 0.0) sum += node.weight * density_at(node.x, mean, sd) * f(left);
  }
  return sum;
}

}  // namespace

NormalLength::NormalLength(const Vec3& mean, const Mat3& covariance) {
  const SymmetricEigen axes = symmetric_eigen(covariance);
  const double largest = std::sqrt(std::max(0.0, axes.values[2]));
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index from = 2 - i;
    const double sd = std::sqrt(std::max(0.0, axes.values[from]));
    sd_[i] = sd > kNoSpread * largest ? sd : 0.0;
    mean_[i] = axes.vectors.col(from).dot(mean);
  }
}

double NormalLength::probability(double r) const {
  static const Quadrature kRule = gauss_legendre(kLengthNodes);
  if (!(r > 0.0)) return 0.0;
  if (sd_[0] == 0.0) return mean_.norm() <= r ? 1.0 : 0.0;
  // The component of least spread outermost, that of the largest in closed form.
  return over_component(kRule, r * r, mean_[2], sd_[2], [&](double left) {
    return over_component(kRule, left, mean_[1], sd_[1], [&](double rest) {
      return within_reach(std::sqrt(rest), mean_[0], sd_[0]);
    });
  });
}

double NormalLength::quantile(double p) const {
  assert(p > 0.0 && p < 1.0);
  if (sd_[0] == 0.0) return mean_.norm();
  double lo = 0.0, hi = mean_.norm() + sd_[0];
  double below = -p, above = probability(hi) - p;
  while (above < 0.0) {
    lo = hi;
    below = above;
    hi *= 2.0;
    above = probability(hi) - p;
  }
  // False position, halved where it stays on one side (Illinois), every third step the middle,
  // which narrows flat parts too; ends at 1e-13 of the length,
  // which a spread of a thousandth of it takes for 1e-10.
  int side = 0;
  for (int step = 0; step < 200 && hi - lo > 1e-13 * hi; ++step) {
    double x = (lo * above - hi * below) / (above - below);
    if (step % 3 == 2 || !(x > lo && x < hi)) x = 0.5 * (lo + hi);
    const double at = probability(x) - p;
    if (at == 0.0) return x;
    if (at < 0.0) {
      lo = x;
      below = at;
      if (side == -1) above *= 0.5;
      side = -1;
    } else {
      hi = x;
      above = at;
      if (side == 1) below *= 0.5;
      side = 1;
    }
  }
  return 0.5 * (lo + hi);
}

double NormalLength::mean() const {
  const double square = mean_.squaredNorm() + sd_.squaredNorm();
  if (square == 0.0) return 0.0;
  // t = exp(s) / E|E|^2; the integrand falls as exp(-|s| / 2) to either side, and the trapezoidal
  // rule on it converges faster than any power of the step.
  constexpr double kStep = 0.125;
  constexpr int kSteps = 640;
  double sum = 0.0;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double t = std::exp(kStep * k) / square;
    double exponent = 0.0;  // log of E exp(-t |E|^2)
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double spread = 2.0 * t * sd_[i] * sd_[i];
      exponent -= 0.5 * std::log1p(spread) + t * mean_[i] * mean_[i] / (1.0 + spread);
    }
    sum += -std::expm1(exponent) / std::sqrt(t);
  }
  return kStep * sum / (2.0 * std::sqrt(std::numbers::pi));
}

double NormalLength::rms() const { return std::sqrt(mean_.squaredNorm() + sd_.squaredNorm()); }

}  // namespace frustum::studies

#include "studies/laws/correlation.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::studies {
namespace {

// A written coefficient has some digits; what differs by more than their rounding is a mistake.
constexpr double kSameCoefficient = 1e-9;
// Below it a group has fewer dimensions than members, and a square root of rounding errors.
constexpr double kSmallestEigenvalue = 1e-12;

Diagnostic no_correlation(const std::string& what, const char* hint) {
  return error("correlation-matrix"_id, "the correlation " + what, hint);
}

}  // namespace

Result<Eigen::MatrixXd> cholesky_of(const Eigen::MatrixXd& correlation, std::size_t size) {
  const auto n = static_cast<Eigen::Index>(size);
  if (correlation.rows() != n || correlation.cols() != n) {
    return no_correlation(
        fmt::format("has {} x {} numbers for {} names", correlation.rows(), correlation.cols(), n),
        "write a row for each name, with a number for each name");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(std::abs(correlation(i, i) - 1.0) <= kSameCoefficient)) {
      return no_correlation(fmt::format("has {:g} on its diagonal", correlation(i, i)),
                            "an error's correlation with itself is 1");
    }
    for (Eigen::Index k = 0; k < i; ++k) {
      if (!(std::abs(correlation(i, k) - correlation(k, i)) <= kSameCoefficient)) {
        return no_correlation(
            fmt::format("is not symmetric: {:g} in row {}, column {}, but {:g} in row {}, column "
                        "{}",
                        correlation(i, k), i + 1, k + 1, correlation(k, i), k + 1, i + 1),
            "write the same number in both places");
      }
    }
  }
  const double smallest = symmetric_eigenvalues(correlation).minCoeff();
  if (!(smallest > kSmallestEigenvalue)) {
    return no_correlation(
        fmt::format("is not positive definite: its smallest eigenvalue is {:.3g}", smallest),
        "no errors are correlated so: make the coefficients smaller");
  }
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k <= i; ++k) {
      double rest = correlation(i, k);
      for (Eigen::Index m = 0; m < k; ++m) rest -= lower(i, m) * lower(k, m);
      lower(i, k) = i == k ? std::sqrt(rest) : rest / lower(k, k);
    }
  }
  return lower;
}

double pearson(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && !x.empty());
  const auto n = static_cast<double>(x.size());
  double x_mean = 0.0, y_mean = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x_mean += x[i] / n;
    y_mean += y[i] / n;
  }
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - x_mean, dy = y[i] - y_mean;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

}  // namespace frustum::studies

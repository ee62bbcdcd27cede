#include "metrology/fit/minimax/linear_minimax.hpp"

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {
namespace {

constexpr int kMost = 8;  // seven unknowns and the level
using Small = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
using SmallSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;

// One inequality: of a row, or of the box when `row` counts on past the rows.
struct Inequality {
  Eigen::Index row = 0;
  double sign = 1.0;
  bool operator==(const Inequality&) const = default;
};

class DualSimplex {
 public:
  DualSimplex(const Eigen::VectorXd& values, const Gradients& gradients, Sides sides,
              const Eigen::VectorXd& reach)
      : values_(values), gradients_(gradients), sides_(sides), reach_(reach) {}

  LinearMinimax solve() {
    start();
    invert();
    const int most = 40 * static_cast<int>(unknowns() + 1);
    for (int i = 0; i < most; ++i) {
      point_ = inverse_ * limits_;
      multipliers_ = -inverse_.row(unknowns()).transpose();
      if (!point_.allFinite()) return {};
      const auto [violator, by] = worst();
      // Rounding of sums of eight products of order one.
      if (by <= 2e-15 * std::max(1.0, std::abs(level()))) {
        if (is_exact_) return report();
        invert();
      } else if (!exchange(violator)) {
        if (is_exact_) return {};
        invert();
      }
    }
    return {};
  }

 private:
  [[nodiscard]] Eigen::Index unknowns() const { return gradients_.cols(); }
  [[nodiscard]] double level() const { return point_[unknowns()]; }
  [[nodiscard]] bool is_box(const Inequality& q) const { return q.row >= values_.size(); }

  [[nodiscard]] Small normal_of(const Inequality& q) const {
    Small normal = Small::Zero(unknowns() + 1);
    if (is_box(q)) {
      normal[q.row - values_.size()] = q.sign;
    } else {
      normal.head(unknowns()) = q.sign * gradients_.row(q.row).transpose();
      normal[unknowns()] = -1.0;
    }
    return normal;
  }
  [[nodiscard]] double limit_of(const Inequality& q) const {
    return is_box(q) ? reach_[q.row - values_.size()] : -q.sign * values_[q.row];
  }

  // The highest function and the faces of the box that it leans on: their multipliers are not
  // negative.
  void start() {
    Inequality top;
    double highest = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      if (sides_.high && values_[i] > highest) top = {i, 1.0}, highest = values_[i];
      if (sides_.low && -values_[i] > highest) top = {i, -1.0}, highest = -values_[i];
    }
    basis_.push_back(top);
    for (Eigen::Index j = 0; j < unknowns(); ++j) {
      const bool grows = top.sign * gradients_(top.row, j) > 0.0;
      basis_.push_back({values_.size() + j, grows ? -1.0 : 1.0});
    }
  }

  // From the rows themselves: exchanges only update it, and lose digits.
  void invert() {
    const Eigen::Index size = unknowns() + 1;
    SmallSquare rows(size, size);
    limits_.resize(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      rows.row(i) = normal_of(basis_[static_cast<std::size_t>(i)]).transpose();
      limits_[i] = limit_of(basis_[static_cast<std::size_t>(i)]);
    }
    inverse_ = frustum::inverse_of(rows);
    is_exact_ = true;
  }

  [[nodiscard]] std::pair<Inequality, double> worst() const {
    Inequality violator;
    double by = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const Inequality& q, double excess) {
      if (excess > by && std::find(basis_.begin(), basis_.end(), q) == basis_.end()) {
        violator = q;
        by = excess;
      }
    };
    const Small t = point_.head(unknowns());
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      const double value = values_[i] + gradients_.row(i).dot(t);
      if (sides_.high) consider({i, 1.0}, value - level());
      if (sides_.low) consider({i, -1.0}, -value - level());
    }
    for (Eigen::Index j = 0; j < unknowns(); ++j) {
      consider({values_.size() + j, t[j] > 0.0 ? 1.0 : -1.0}, std::abs(t[j]) - reach_[j]);
    }
    return {violator, by};
  }

  bool exchange(const Inequality& entering) {
    const Small share = inverse_.transpose() * normal_of(entering);
    Eigen::Index leaving = -1;
    double least = std::numeric_limits<double>::infinity();
    const double significant = 1e-12 * share.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      if (share[i] <= significant) continue;
      const double ratio = std::max(multipliers_[i], 0.0) / share[i];
      // Of equal ratios the larger share keeps the basis well conditioned.
      if (leaving < 0 || ratio < least - 1e-14 ||
          (ratio <= least + 1e-14 && share[i] > share[leaving])) {
        leaving = i;
        least = std::min(least, ratio);
      }
    }
    if (leaving < 0) return false;
    basis_[static_cast<std::size_t>(leaving)] = entering;
    limits_[leaving] = limit_of(entering);
    Small change = share;
    change[leaving] -= 1.0;
    const Small column = inverse_.col(leaving) / share[leaving];
    inverse_ -= column * change.transpose();
    is_exact_ = false;
    return true;
  }

  [[nodiscard]] LinearMinimax report() const {
    LinearMinimax found;
    found.step = point_.head(unknowns());
    found.level = level();
    found.solved = true;
    // A multiplier below 1e-12 pulls no more than the rounding of the others.
    constexpr double kPull = 1e-12;
    for (std::size_t i = 0; i < basis_.size(); ++i) {
      const double multiplier = multipliers_[static_cast<Eigen::Index>(i)];
      if (multiplier <= kPull) continue;
      if (is_box(basis_[i])) {
        found.at_bound = true;
      } else {
        found.active.push_back({basis_[i].row, basis_[i].sign, multiplier});
      }
    }
    return found;
  }

  const Eigen::VectorXd& values_;
  const Gradients& gradients_;
  Sides sides_;
  const Eigen::VectorXd& reach_;
  std::vector<Inequality> basis_{};
  SmallSquare inverse_{};
  Small limits_{};
  bool is_exact_ = false;
  Small point_{};
  Small multipliers_{};
};

}  // namespace

LinearMinimax linear_minimax(const Eigen::VectorXd& values, const Gradients& gradients, Sides sides,
                             const Eigen::VectorXd& reach) {
  return DualSimplex(values, gradients, sides, reach).solve();
}

}  // namespace frustum::metrology

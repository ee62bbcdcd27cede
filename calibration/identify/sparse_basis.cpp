#include "calibration/identify/sparse_basis.hpp"

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "core/linear_algebra.hpp"

namespace frustum::calibration {
namespace {

using Indices = std::vector<Eigen::Index>;

// Supports tried of one size; beyond that elimination is sparse enough. 20,000 take 0.1 s.
constexpr double kMostTries = 20000.0;

double combinations(Eigen::Index n, Eigen::Index k) {
  double count = 1.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    count *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return count;
}

// Next combination of size k out of n, in lexicographic order.
bool advance(Indices& chosen, Eigen::Index n) {
  const auto k = static_cast<Eigen::Index>(chosen.size());
  for (Eigen::Index i = k - 1; i >= 0; --i) {
    auto& entry = chosen[static_cast<std::size_t>(i)];
    if (entry < n - k + i) {
      ++entry;
      for (Eigen::Index j = i + 1; j < k; ++j) {
        chosen[static_cast<std::size_t>(j)] = chosen[static_cast<std::size_t>(j - 1)] + 1;
      }
      return true;
    }
  }
  return false;
}

Eigen::VectorXd cleaned(const Eigen::VectorXd& v, double tolerance) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const Eigen::VectorXd scaled = v / v[largest];
  return (scaled.array().abs() < tolerance).select(0.0, scaled);
}

class Search {
 public:
  Search(const Eigen::MatrixXd& basis, double tolerance)
      : basis_(basis), tolerance_(tolerance), found_(basis.rows(), 0) {
    for (Eigen::Index i = 0; i < basis.rows(); ++i) {
      if (basis.row(i).norm() > tolerance) touched_.push_back(i);
    }
    gram_ = basis(touched_, Eigen::all).transpose() * basis(touched_, Eigen::all);
  }

  Eigen::MatrixXd run() {
    const auto n = static_cast<Eigen::Index>(touched_.size());
    for (Eigen::Index together = 1; together <= std::min<Eigen::Index>(kMostTogether, n);
         ++together) {
      if (combinations(n, together) > kMostTries) break;
      Indices chosen(static_cast<std::size_t>(together));
      for (Eigen::Index i = 0; i < together; ++i) chosen[static_cast<std::size_t>(i)] = i;
      do {
        if (found_.cols() == basis_.cols()) return found_;
        if (const auto vector = supported_on(chosen)) keep(*vector);
      } while (advance(chosen, n));
    }
    complete();
    return found_;
  }

 private:
  // The vector of the subspace that vanishes outside the chosen entries, if there is one.
  [[nodiscard]] std::optional<Eigen::VectorXd> supported_on(const Indices& chosen) const {
    Eigen::MatrixXd outside = gram_;
    for (const Eigen::Index i : chosen) {
      const auto row = basis_.row(touched_[static_cast<std::size_t>(i)]);
      outside -= row.transpose() * row;
    }
    const SymmetricEigen eigen = symmetric_eigen(outside);
    // Squares: the part outside is below the tolerance.
    if (!(eigen.values[0] < tolerance_ * tolerance_)) return std::nullopt;
    return cleaned(basis_ * eigen.vectors.col(0), tolerance_);
  }

  void keep(const Eigen::VectorXd& vector) {
    Eigen::MatrixXd more(basis_.rows(), found_.cols() + 1);
    more << found_, vector;
    if (column_rank(more, tolerance_) == more.cols()) found_ = more;
  }

  // Elimination with the largest entry as pivot: each vector owns one entry of its own.
  void complete() {
    Eigen::MatrixXd rest = basis_;
    for (Eigen::Index k = 0; k < rest.cols(); ++k) {
      Eigen::Index row = 0;
      Eigen::Index col = 0;
      rest.rightCols(rest.cols() - k).cwiseAbs().maxCoeff(&row, &col);
      rest.col(k).swap(rest.col(k + col));
      rest.col(k) /= rest(row, k);
      for (Eigen::Index j = 0; j < rest.cols(); ++j) {
        if (j != k) rest.col(j) -= rest(row, j) * rest.col(k);
      }
    }
    for (Eigen::Index k = 0; k < rest.cols() && found_.cols() < basis_.cols(); ++k) {
      keep(cleaned(rest.col(k), tolerance_));
    }
  }

  const Eigen::MatrixXd& basis_;
  double tolerance_;
  Eigen::MatrixXd found_;
  Indices touched_{};
  Eigen::MatrixXd gram_{};
};

}  // namespace

Eigen::MatrixXd sparse_basis(const Eigen::MatrixXd& orthonormal, double tolerance) {
  if (orthonormal.cols() == 0) return orthonormal;
  return Search(orthonormal, tolerance).run();
}

}  // namespace frustum::calibration

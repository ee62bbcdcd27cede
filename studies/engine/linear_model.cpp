#include "studies/engine/linear_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::studies {
namespace {

// Motions whose part beside all others is this share of the largest are the others again.
constexpr double kSameMotion = 1e-9;
// A motion of this share of the largest is rounding: levers are from 1 to 1,000 mm.
constexpr double kNoMotion = 1e-12;

}  // namespace

Eigen::MatrixXd centred(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& motions) {
  // Of one size, so that turning and shifting count alike.
  Eigen::MatrixXd scaled = motions;
  const double largest = scaled.colwise().norm().maxCoeff();
  for (Eigen::Index k = 0; k < scaled.cols(); ++k) {
    const double length = scaled.col(k).norm();
    scaled.col(k) *= length > kNoMotion * largest ? 1.0 / length : 0.0;
  }
  const SingularValues svd = singular_values(scaled, SingularVectors::thin);
  Eigen::Index rank = 0;
  while (rank < svd.values.size() && svd.values[rank] > kSameMotion * svd.values[0]) ++rank;
  const Eigen::MatrixXd basis = svd.left.leftCols(rank);
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

Eigen::MatrixXd element_motions(std::span<const Vec3> points, std::span<const Vec3> normals,
                                ElementSize size, const Vec3& axis) {
  assert(points.size() == normals.size() && !points.empty());
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : points) centroid += p / static_cast<double>(points.size());
  Eigen::MatrixXd motions(static_cast<Eigen::Index>(points.size()), 7);
  for (Eigen::Index i = 0; i < motions.rows(); ++i) {
    const Vec3& n = normals[static_cast<std::size_t>(i)];
    const Vec3 p = points[static_cast<std::size_t>(i)] - centroid;
    motions.block<1, 3>(i, 0) = n.transpose();
    motions.block<1, 3>(i, 3) = p.cross(n).transpose();
    motions(i, 6) = 0.0;
    if (size == ElementSize::radius) motions(i, 6) = 1.0;
    if (size == ElementSize::half_angle) {
      const Vec3 along = axis.cross(n).cross(n).normalized();  // the generatrix, down the axis
      motions(i, 6) = p.dot(axis) / along.dot(axis);
    }
  }
  return motions;
}

namespace {

double worst_range(const LinearRange& range, const Eigen::VectorXd& moved) {
  if (range.rows.empty()) return moved.maxCoeff() - moved.minCoeff();
  double worst = 0.0;
  Eigen::Index first = 0;
  for (const std::size_t count : range.rows) {
    const auto row = moved.segment(first, static_cast<Eigen::Index>(count));
    worst = std::max(worst, row.maxCoeff() - row.minCoeff());
    first += row.size();
  }
  return worst;
}

double longest(const LinearLength& length, const Eigen::VectorXd& moved) {
  const auto dimensions = static_cast<Eigen::Index>(length.dimensions);
  double square = 0.0;
  for (Eigen::Index first = 0; first < moved.size(); first += dimensions) {
    square = std::max(square, moved.segment(first, dimensions).squaredNorm());
  }
  return length.factor * std::sqrt(square);
}

// One overload a kind.
struct ValueOf {
  const Eigen::VectorXd& weights;

  double operator()(const LinearSum& sum) const { return sum.constant + sum.gains.dot(weights); }
  double operator()(const LinearRange& range) const { return worst_range(range, moved(range)); }
  double operator()(const LinearReach& reach) const {
    return reach.factor * moved(reach).cwiseAbs().maxCoeff();
  }
  double operator()(const LinearLength& length) const { return longest(length, moved(length)); }

  template <typename Points>
  [[nodiscard]] Eigen::VectorXd moved(const Points& points) const {
    return points.nominal + points.gains * weights;
  }
};

}  // namespace

Eigen::MatrixXd gains_of(const LinearCharacteristic& characteristic) {
  if (const auto* sum = std::get_if<LinearSum>(&characteristic.of)) return sum->gains.transpose();
  return std::visit([](const auto& of) -> Eigen::MatrixXd { return of.gains; }, characteristic.of);
}

double value_of(const LinearCharacteristic& characteristic, const Eigen::VectorXd& weights) {
  return std::visit(ValueOf{weights}, characteristic.of);
}

}  // namespace frustum::studies

#include "studies/engine/linear_model.hpp"

#include <cassert>

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

double value_of(const LinearCharacteristic& characteristic, const Eigen::VectorXd& weights) {
  if (const auto* sum = std::get_if<LinearSum>(&characteristic.of))
    return sum->constant + sum->gains.dot(weights);
  const auto& range = std::get<LinearRange>(characteristic.of);
  const Eigen::VectorXd moved = range.nominal + range.gains * weights;
  return moved.maxCoeff() - moved.minCoeff();
}

}  // namespace frustum::studies

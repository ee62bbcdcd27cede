#include "metrology/normalised_points.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace frustum::metrology {

Result<NormalisedPoints> normalise(std::span<const Vec3> points, std::string_view what,
                                   std::size_t least) {
  if (points.size() < least) {
    return error(
        fmt::format("too few points for a {}: {} given, {} needed", what, points.size(), least));
  }
  NormalisedPoints local;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      return error(fmt::format("point {} is not finite", i + 1), "remove it from the points");
    }
    local.centre += points[i] / static_cast<double>(points.size());
  }
  double farthest = 0.0;
  for (const Vec3& p : points) {
    local.points.emplace_back(p - local.centre);
    farthest = std::max(farthest, local.points.back().norm());
  }
  // Coordinates of 1000 mm are rounded to 1e-13 mm: what is nearer than ten times that is one
  // point.
  if (!(farthest > 1e-15 * (1e3 + local.centre.norm()))) {
    return error(fmt::format("degenerate points for a {}: all of them coincide", what));
  }
  local.scale = std::exp2(std::round(std::log2(farthest)));
  Vec3 mean = Vec3::Zero();
  for (Vec3& p : local.points) {
    p /= local.scale;
    mean += p / static_cast<double>(points.size());
  }
  // The first mean was rounded at the size of the coordinates; this one at the size of the part.
  for (Vec3& p : local.points) p -= mean;
  local.centre += local.scale * mean;
  return local;
}

PrincipalDirections principal_directions(const NormalisedPoints& local) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> rows(static_cast<Eigen::Index>(local.points.size()), 3);
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = local.points[i].transpose();
  }
  // Directions from the points themselves, not from their covariance matrix, which squares the
  // errors.
  const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(rows);
  Mat3 triangle = Mat3::Zero();
  const Eigen::Index filled = std::min<Eigen::Index>(3, rows.rows());
  triangle.topRows(filled) = qr.matrixQR().topRows(filled).template triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Mat3> svd(triangle, Eigen::ComputeFullV);
  PrincipalDirections principal;
  if (svd.info() == Eigen::Success) {  // always, for finite points
    principal.spread = svd.singularValues() / std::sqrt(static_cast<double>(local.points.size()));
    principal.directions = svd.matrixV();
  }
  return principal;
}

void complete(const NormalisedPoints& local, std::span<const double> local_residuals,
              const Eigen::MatrixXd& local_cofactor, std::span<const bool> is_angle,
              double redundancy, std::vector<double>& residuals, double& form, double& rms,
              Eigen::MatrixXd& cofactor, Eigen::MatrixXd& covariance) {
  double sum = 0.0;
  for (const double d : local_residuals) {
    residuals.push_back(d * local.scale);
    sum += residuals.back() * residuals.back();
  }
  const auto [low, high] = std::minmax_element(residuals.begin(), residuals.end());
  form = *high - *low;
  const auto n = static_cast<double>(residuals.size());
  rms = std::sqrt(sum / n);
  cofactor = local_cofactor;
  for (Eigen::Index i = 0; i < cofactor.rows(); ++i) {
    for (Eigen::Index j = 0; j < cofactor.cols(); ++j) {
      if (is_angle[static_cast<std::size_t>(i)]) cofactor(i, j) /= local.scale;
      if (is_angle[static_cast<std::size_t>(j)]) cofactor(i, j) /= local.scale;
    }
  }
  covariance = cofactor * (redundancy > 0.0 ? sum / redundancy : 0.0);
}

UnitVec3 canonical(const Vec3& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return unit(axis(largest) < 0.0 ? Vec3(-axis) : axis);
}

}  // namespace frustum::metrology

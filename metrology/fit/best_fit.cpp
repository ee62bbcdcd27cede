#include "metrology/fit/best_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace frustum::metrology {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// A direction in which the sum of squares curves less than this share of the largest is not
// reported: rotations are scaled by the size of the part, so what is reported is of order one.
constexpr double kUntold = 1e-10;

// Normal equations of the motion of the points against the planned geometry, about `centre`,
// rotations times `size`.
struct Normal {
  Mat6 matrix = Mat6::Zero();
  Vec6 right = Vec6::Zero();
};
Normal normal_of(std::span<const PointOnElement> points, const Pose& planned_from_measured,
                 const Vec3& centre, double size, const std::array<bool, 6>& locked) {
  Normal n;
  for (const PointOnElement& p : points) {
    const Vec3 x = planned_from_measured.point(p.point);
    const Vec3 normal = outward_normal(*p.planned, x);
    Vec6 row;
    row << normal, (x - centre).cross(normal) / size;
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (locked[static_cast<std::size_t>(k)]) row[k] = 0.0;
    }
    n.matrix += row * row.transpose();
    n.right -= row * residual(*p.planned, x);
  }
  return n;
}

}  // namespace

Result<BestFit> best_fit(std::span<const PointOnElement> points,
                         const std::array<bool, 6>& locked) {
  if (points.empty()) return error("too-few-points"_id, "a best fit without points");
  Vec3 centre = Vec3::Zero();
  for (const PointOnElement& p : points) centre += p.point / static_cast<double>(points.size());
  // Locked rotations are about the origin: only there do they leave shifts alone.
  if (locked[0] || locked[1] || locked[2]) centre = Vec3::Zero();
  double size = 0.0;
  for (const PointOnElement& p : points) size = std::max(size, (p.point - centre).norm());
  if (!(size > 0.0)) size = 1.0;

  Pose planned_from_measured;
  BestFit found;
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    const Normal n = normal_of(points, planned_from_measured, centre, size, locked);
    const Eigen::SelfAdjointEigenSolver<Mat6> eigen(n.matrix);
    const double largest = eigen.eigenvalues().maxCoeff();
    Vec6 step = Vec6::Zero();
    Vec6 told = Vec6::Zero();
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (!(eigen.eigenvalues()[k] > kUntold * largest)) continue;
      const Vec6 way = eigen.eigenvectors().col(k);
      step += way.dot(n.right) / eigen.eigenvalues()[k] * way;
      told += way.cwiseAbs2();
    }
    const Vec3 turn = step.tail<3>() / size;
    const double angle = turn.norm();
    Mat3 rotation = Mat3::Identity();
    if (angle > 0.0) rotation = rotation_about(turn / angle, angle);
    const Pose motion{rotation, centre + step.head<3>() - rotation * centre};
    planned_from_measured = motion * planned_from_measured;
    if (!step.allFinite()) break;
    if (step.norm() > 1e-13 * size) continue;
    found.measured_from_planned = planned_from_measured.inverse();
    for (std::size_t k = 0; k < 6; ++k) {
      // Of two degrees that share one direction the one with the larger part counts.
      found.is_told[k] = !locked[k] && told[static_cast<Eigen::Index>(k)] > 0.5;
    }
    return found;
  }
  return error("fit-not-converged"_id, "the best fit does not settle",
               "check that the points belong to the planned features and are near them");
}

}  // namespace frustum::metrology

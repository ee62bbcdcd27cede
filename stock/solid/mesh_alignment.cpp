#include "stock/solid/mesh_alignment.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::stock {
namespace {

using Row = Eigen::Matrix<double, 6, 1>;

struct Moved {
  Row row = Row::Zero();
  double distance = 0.0;
};

std::vector<Vec3> some_of(std::span<const Vec3> points) {
  constexpr std::size_t kMost = 20000;
  std::vector<Vec3> some;
  const std::size_t count = std::min(points.size(), kMost);
  for (std::size_t i = 0; i < count; ++i) some.push_back(points[i * points.size() / count]);
  return some;
}

}  // namespace

Result<MeshAlignment> laid_into(const FacetSolid& nominal, std::span<const Vec3> points) {
  if (points.empty() || nominal.facets().empty()) {
    return error("too-few-points"_id, "a best fit needs points and facets");
  }
  const std::vector<Vec3> part = some_of(points);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : part) centre += p / static_cast<double>(part.size());
  double size = 0.0;
  for (const Vec3& p : part) size = std::max(size, (p - centre).norm());
  if (!(size > 0.0)) size = 1.0;
  MeshAlignment found;
  std::vector<Moved> moved(part.size());
  constexpr int kMost = 200;
  constexpr double kStill = 1e-9;  // of the size
  for (found.rounds = 1; found.rounds <= kMost; ++found.rounds) {
    tbb::parallel_for(std::size_t{0}, part.size(), [&](std::size_t i) {
      const Vec3 x = found.nominal_from_part.point(part[i]);
      const FacetSolid::Nearest foot = nominal.nearest(x);
      Vec3 normal = nominal.normal(foot.facet);
      // Beside an edge the way to it is the normal.
      const Vec3 off = x - foot.point;
      constexpr double kOn = 1e-9;  // mm
      if (foot.distance > kOn) normal = off / foot.distance;
      moved[i].row << normal, (x - centre).cross(normal) / size;
      moved[i].distance = off.dot(normal);
    });
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(6, 6);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(6);
    double sum = 0.0;
    for (const Moved& m : moved) {
      squares += m.row * m.row.transpose();
      right -= m.distance * m.row;
      sum += m.distance * m.distance;
    }
    found.rms = std::sqrt(sum / static_cast<double>(part.size()));
    // What slides in itself is left where it is.
    constexpr double kTold = 1e-8;
    const SymmetricEigen eigen = symmetric_eigen(squares);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(6);
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (eigen.values[k] <= kTold * eigen.values[5]) continue;
      const Eigen::VectorXd way = eigen.vectors.col(k);
      step += way.dot(right) / eigen.values[k] * way;
    }
    if (!step.allFinite()) break;
    const Vec3 turn = step.tail<3>() / size;
    const double angle = turn.norm();
    const Mat3 rotation = angle > 0.0 ? rotation_about(turn / angle, angle) : Mat3::Identity();
    const Pose about{rotation, centre + Vec3(step.head<3>()) - rotation * centre};
    found.nominal_from_part = about * found.nominal_from_part;
    if (step.head<3>().norm() + size * angle <= kStill * size) return found;
  }
  return error("fit-not-converged"_id, "the best fit does not settle",
               "bring the part near its nominal shape first, or check that it is the same part");
}

}  // namespace frustum::stock

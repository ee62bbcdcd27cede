#include "stock/solid/mesh_alignment.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::stock {
namespace {

using Row = Eigen::Matrix<double, 6, 1>;

// The distances of the points at a pose and how they change with six small motions.
struct Linearised {
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6);
  double sum = 0.0;  // of their squares

  // By Gauss and Newton; what slides in itself is left where it is.
  [[nodiscard]] Row step() const {
    constexpr double kIdentified = 1e-8;
    const SymmetricEigen eigen = symmetric_eigen(squares);
    Row step = Row::Zero();
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (eigen.values[k] <= kIdentified * eigen.values[5]) continue;
      const Eigen::VectorXd way = eigen.vectors.col(k);
      step += way.dot(right) / eigen.values[k] * way;
    }
    return step;
  }
};

class FitSystem {
 public:
  FitSystem(const FacetSolid& nominal, std::span<const Vec3> part, const Vec3& centre, double size)
      : nominal_(nominal), part_(part), centre_(centre), size_(size) {}

  [[nodiscard]] Linearised at(const Pose& nominal_from_part) const {
    struct Moved {
      Row row = Row::Zero();
      double distance = 0.0;
    };
    std::vector<Moved> moved(part_.size());
    tbb::parallel_for(std::size_t{0}, part_.size(), [&](std::size_t i) {
      const Vec3 x = nominal_from_part.point(part_[i]);
      const FacetSolid::Nearest foot = nominal_.nearest(x);
      Vec3 normal = nominal_.normal(foot.facet);
      // Beside an edge the way to it is the normal.
      const Vec3 off = x - foot.point;
      constexpr double kOn = 1e-9;  // mm
      if (foot.distance > kOn) normal = off / foot.distance;
      moved[i].row << normal, (x - centre_).cross(normal) / size_;
      moved[i].distance = off.dot(normal);
    });
    Linearised found;
    for (const Moved& m : moved) {
      found.squares += m.row * m.row.transpose();
      found.right -= m.distance * m.row;
      found.sum += m.distance * m.distance;
    }
    return found;
  }

  // About the centre; the turn in sizes.
  [[nodiscard]] Pose moved(const Pose& pose, const Row& step) const {
    const Vec3 turn = step.tail<3>() / size_;
    const double angle = turn.norm();
    const Mat3 rotation = angle > 0.0 ? rotation_about(turn / angle, angle) : Mat3::Identity();
    return Pose{rotation, centre_ + Vec3(step.head<3>()) - rotation * centre_} * pose;
  }

 private:
  const FacetSolid& nominal_;
  std::span<const Vec3> part_;
  Vec3 centre_;
  double size_;
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
  const FitSystem system(nominal, part, centre, size);
  MeshAlignment found;
  Linearised here = system.at(found.nominal_from_part);
  constexpr int kMost = 200;
  constexpr double kStill = 1e-9, kSame = 1e-12;  // of the size; of the sum of squares
  for (found.rounds = 1; found.rounds <= kMost; ++found.rounds) {
    found.rms = std::sqrt(here.sum / static_cast<double>(part.size()));
    const Row step = here.step();
    if (!step.allFinite()) break;
    const auto length = [](const Row& s) { return s.head<3>().norm() + s.tail<3>().norm(); };
    // Points change facets on the way, where a whole step may lead past the least: back half way.
    double share = 1.0;
    for (;; share *= 0.5) {
      if (share * length(step) <= kStill * size) return found;
      const Pose next = system.moved(found.nominal_from_part, share * step);
      Linearised there = system.at(next);
      // A quarter of what the slope promises, so that steps to and fro do not count.
      const double promised = 2.0 * share * here.right.dot(Eigen::VectorXd(step));
      if (!(here.sum - there.sum > 0.25 * promised)) continue;
      const bool same = here.sum - there.sum <= kSame * here.sum;
      found.nominal_from_part = next;
      here = std::move(there);
      found.rms = std::sqrt(here.sum / static_cast<double>(part.size()));
      if (same) return found;
      break;
    }
  }
  return error("fit-not-converged"_id, "the best fit does not settle",
               "bring the part near its nominal shape first, or check that it is the same part");
}

}  // namespace frustum::stock

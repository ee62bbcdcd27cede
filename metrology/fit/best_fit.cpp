#include "metrology/fit/best_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "core/linear_algebra.hpp"
#include "core/units.hpp"

namespace frustum::metrology {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// A direction in which the sum of squares curves less than this share of the largest is not
// reported: rotations are scaled by the size of the part, so what is reported is of order one.
constexpr double kUntold = 1e-10;
// Nor is one in which what the points say to first order is no more than twice what the bend of
// the surfaces makes of the deviations: a section tilts if its circle is oval, and a parallel
// circle of a ball slides along its axis if it is small, but that says nothing of how the part
// lies, and may have its minimum degrees away.
constexpr double kLargestBend = 0.5;
// Steadily told is a direction of which the points say at least half as much, in the same sense,
// when the part lies 2 deg otherwise: what an oblique section says of its tilt is nothing where it
// is square, and the contrary beyond.
constexpr double kSteadyTurn = 2.0 * kRadPerDeg;
constexpr double kSteadyShare = 0.5;

// Locked rotations are about the origin: only there do they leave shifts alone.
Vec3 centre_of(std::span<const PointOnElement> points, const std::array<bool, 6>& locked) {
  Vec3 centre = Vec3::Zero();
  if (locked[0] || locked[1] || locked[2]) return centre;
  for (const PointOnElement& p : points) centre += p.point / static_cast<double>(points.size());
  return centre;
}

// The points and elements about `centre`, so that coordinates are no larger than the part, and the
// degrees that are free.
struct Task {
  std::vector<NominalSurface> elements{};
  std::vector<Vec3> points{};
  std::vector<std::size_t> element_of{};  // of each point, in `elements`
  double size = 1.0;
  std::array<bool, 6> locked{};
};

Task task_of(std::span<const PointOnElement> points, const Vec3& centre,
             const std::array<bool, 6>& locked) {
  Task task;
  task.locked = locked;
  task.size = 0.0;
  const Pose to_centre{Mat3::Identity(), -centre};
  std::map<const NominalSurface*, std::size_t> known;
  for (const PointOnElement& p : points) {
    const auto [place, is_new] = known.try_emplace(p.planned, task.elements.size());
    if (is_new) task.elements.push_back(transformed(to_centre, *p.planned));
    task.element_of.push_back(place->second);
    task.points.push_back(p.point - centre);
    task.size = std::max(task.size, task.points.back().norm());
  }
  if (!(task.size > 0.0)) task.size = 1.0;
  return task;
}

// Shift and rotation, the latter times the size of the part, as a motion.
Pose motion_of(const Vec6& step, double size) {
  const Vec3 turn = step.tail<3>() / size;
  const double angle = turn.norm();
  Mat3 rotation = Mat3::Identity();
  if (angle > 0.0) rotation = rotation_about(turn / angle, angle);
  return {rotation, step.head<3>()};
}

// The motion of a body that keeps this velocity for the time 1: a screw.
Pose screw_of(const Vec6& velocity, double size) {
  const Vec3 turn = velocity.tail<3>() / size, shift = velocity.head<3>();
  const double angle = turn.norm();
  if (!(angle > 0.0)) return {Mat3::Identity(), shift};
  const Vec3 once = turn.cross(shift), twice = turn.cross(once);
  return {rotation_about(turn / angle, angle),
          shift + (1.0 - std::cos(angle)) / (angle * angle) * once +
              (angle - std::sin(angle)) / (angle * angle * angle) * twice};
}

// Normal equations of the motion of the points against the planned geometry.
struct Normal {
  Mat6 matrix = Mat6::Zero();
  Vec6 right = Vec6::Zero();  // minus half the gradient of the sum of squares
};
Normal normal_of(const Task& task, const Pose& planned_from_measured) {
  Normal n;
  for (std::size_t i = 0; i < task.points.size(); ++i) {
    const NominalSurface& planned = task.elements[task.element_of[i]];
    const Vec3 x = planned_from_measured.point(task.points[i]);
    const NominalFoot foot = nearest(planned, x);
    Vec6 row;
    row << foot.normal, x.cross(foot.normal) / task.size;
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (task.locked[static_cast<std::size_t>(k)]) row[k] = 0.0;
    }
    n.matrix += row * row.transpose();
    n.right -= row * foot.distance;
  }
  return n;
}

bool is_steady(const Task& task, const Pose& planned_from_measured, const Vec6& way) {
  // How far each point goes along its normal, by the way.
  const auto says = [&](std::size_t i, const Pose& pose) {
    const Vec3 x = pose.point(task.points[i]);
    const Vec3 normal = outward_normal(task.elements[task.element_of[i]], x);
    return normal.dot(way.head<3>() + way.tail<3>().cross(x) / task.size);
  };
  std::vector<double> own(task.points.size());
  double here = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = says(i, planned_from_measured);
    here += own[i] * own[i];
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double turn : {kSteadyTurn, -kSteadyTurn}) {
      const Pose turned{rotation_about(Vec3::Unit(axis), turn), Vec3::Zero()};
      const Pose moved = turned * planned_from_measured;
      double there = 0.0;
      for (std::size_t i = 0; i < own.size(); ++i) there += own[i] * says(i, moved);
      if (!(there >= kSteadyShare * here)) return false;
    }
  }
  return true;
}

// The directions in which the points say how they lie, at a pose.
std::vector<Vec6> told_ways(const Task& task, const Pose& planned_from_measured, Telling telling) {
  const SymmetricEigen eigen = symmetric_eigen(normal_of(task, planned_from_measured).matrix);
  const double largest = eigen.values.maxCoeff();
  std::vector<Vec6> told;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double curvature = eigen.values[k];
    if (!(curvature > kUntold * largest)) continue;
    const Vec6 way = eigen.vectors.col(k);
    // The whole curvature of half the sum of squares, by differences of its gradient.
    const double h = 1e-4 * task.size;
    const auto slope = [&](double step) {
      const Pose moved = motion_of(step * way, task.size) * planned_from_measured;
      return -way.dot(normal_of(task, moved).right);
    };
    const double whole = (slope(h) - slope(-h)) / (2.0 * h);
    if (!(std::abs(whole - curvature) <= kLargestBend * curvature)) continue;
    if (telling == Telling::any || is_steady(task, planned_from_measured, way)) {
      told.push_back(way);
    }
  }
  return told;
}

// Those that need no such proof as planned.
std::vector<Vec6> strong_ways(const Task& task, Telling telling) {
  const SymmetricEigen eigen = symmetric_eigen(normal_of(task, {}).matrix);
  constexpr double kStrong = 1e-3;  // of the largest: a lever arm of 3 % of the part
  std::vector<Vec6> strong;
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (!(eigen.values[k] > kStrong * eigen.values.maxCoeff())) continue;
    const Vec6 way = eigen.vectors.col(k);
    if (telling == Telling::any || is_steady(task, {}, way)) strong.push_back(way);
  }
  return strong;
}

// The largest change of a deviation by a motion along each free direction that the points, laid
// into the planned geometry, do not tell.
double bend_of_untold(const Task& laid, Telling telling) {
  constexpr double kTurn = kRadPerDeg;
  const auto without = [](Vec6 v, const std::vector<Vec6>& others) {
    for (const Vec6& other : others) v -= other.dot(v) * other;
    return v;
  };
  const std::vector<Vec6> told = told_ways(laid, {}, telling);
  std::vector<Vec6> untold;
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (laid.locked[static_cast<std::size_t>(k)]) continue;
    const Vec6 left = without(without(Vec6::Unit(k), told), untold);
    // What rounding leaves of a direction that is told is no direction.
    constexpr double kNothing = 1e-6;
    if (left.norm() > kNothing) untold.push_back(without(left.normalized(), told).normalized());
  }
  double largest = 0.0;
  for (const Vec6& way : untold) {
    const Pose moves = screw_of(kTurn * laid.size * way, laid.size);
    for (std::size_t i = 0; i < laid.points.size(); ++i) {
      const NominalSurface& planned = laid.elements[laid.element_of[i]];
      const double before = residual(planned, laid.points[i]);
      const double after = residual(planned, moves.point(laid.points[i]));
      largest = std::max(largest, std::abs(after - before));
    }
  }
  return largest;
}

// Gauss-Newton along these directions; nothing where it does not settle.
std::optional<Pose> settled(const Task& task, const std::vector<Vec6>& ways, Pose pose) {
  if (ways.empty()) return pose;
  constexpr int kRounds = 100;
  // mm, root mean square of how far the last step moves the points along their normals.
  const double limit = 1e-13 * task.size * std::sqrt(static_cast<double>(task.points.size()));
  Eigen::MatrixXd basis(6, static_cast<Eigen::Index>(ways.size()));
  for (std::size_t k = 0; k < ways.size(); ++k) basis.col(static_cast<Eigen::Index>(k)) = ways[k];
  for (int round = 0; round < kRounds; ++round) {
    const Normal n = normal_of(task, pose);
    const Eigen::MatrixXd matrix = basis.transpose() * n.matrix * basis;
    const Vec6 step =
        basis * SymmetricFactors(matrix).solve(Eigen::VectorXd(basis.transpose() * n.right));
    if (!step.allFinite()) return std::nullopt;
    pose = motion_of(step, task.size) * pose;
    if (std::sqrt(std::max(0.0, step.dot(n.matrix * step))) <= limit) return pose;
  }
  return std::nullopt;
}

}  // namespace

Result<BestFit> best_fit(std::span<const PointOnElement> points, const std::array<bool, 6>& locked,
                         Telling telling) {
  if (points.empty()) return error("too-few-points"_id, "a best fit without points");
  const Vec3 centre = centre_of(points, locked);
  const Task task = task_of(points, centre, locked);

  // Far from the points the bend of the surfaces hides what they say: the directions are chosen
  // again where those chosen before led, until there is nothing to choose.
  Pose pose;
  std::vector<Vec6> ways = strong_ways(task, telling);
  bool has_settled = false;
  constexpr int kChoices = 4;
  for (int choice = 0; choice < kChoices; ++choice) {
    const std::optional<Pose> found = settled(task, ways, pose);
    has_settled = found.has_value();
    if (found) pose = *found;
    std::vector<Vec6> again = told_ways(task, pose, telling);
    if (has_settled && again.size() == ways.size() && choice > 0) break;
    ways = std::move(again);
  }
  if (!has_settled) {
    return error("fit-not-converged"_id, "the best fit does not settle",
                 "check that the points belong to the planned features and are near them");
  }
  BestFit found;
  const Pose from_centre{Mat3::Identity(), centre};
  found.measured_from_planned = from_centre * pose.inverse() * from_centre.inverse();
  Vec6 told = Vec6::Zero();
  for (const Vec6& way : ways) told += way.cwiseAbs2();
  for (std::size_t k = 0; k < 6; ++k) {
    // Of two degrees that share one direction the one with the larger part counts.
    found.is_told[k] = !locked[k] && told[static_cast<Eigen::Index>(k)] > 0.5;
  }
  std::vector<PointOnElement> laid(points.begin(), points.end());
  const Pose planned_from_measured = found.measured_from_planned.inverse();
  for (PointOnElement& p : laid) p.point = planned_from_measured.point(p.point);
  found.bend_of_untold = bend_of_untold(task_of(laid, centre_of(laid, locked), locked), telling);
  return found;
}

}  // namespace frustum::metrology

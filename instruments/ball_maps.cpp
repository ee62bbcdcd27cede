#include "instruments/ball_maps.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/counted.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using PoseGrid = std::vector<std::vector<ErrorVector>>;

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

std::optional<Diagnostic> in_line(std::span<const Vec3> balls) {
  if (balls.size() < 3) {
    return error("balls-in-line"_id,
                 fmt::format("turns of the table are open with {}: maps need three that are "
                             "not in line",
                             counted(balls.size(), "ball")));
  }
  const Vec3 first = balls[1] - balls[0];
  for (const Vec3& ball : balls) {
    constexpr double kApart = 1.0;  // mm off the line of the others
    if (first.cross(ball - balls[0]).norm() > kApart * first.norm()) return std::nullopt;
  }
  return error("balls-in-line"_id,
               "the balls are in line: a turn of the table about their line is not seen",
               "move one of them sideways");
}

// Six rows, three columns a ball: what its displacements from those at zero add to the pose.
Eigen::MatrixXd estimator_of(const Mat3& rotation, std::span<const Vec3> balls) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(3 * balls.size()), 6);
  for (std::size_t k = 0; k < balls.size(); ++k) {
    rows.middleRows<3>(static_cast<Eigen::Index>(3 * k)) << Mat3::Identity(),
        -cross_matrix(rotation * balls[k]);
  }
  const Eigen::MatrixXd transposed = rows.transpose();
  return SymmetricFactors(transposed * rows).solve(transposed);
}

// The balls about the crossing of the axes.
std::vector<Vec3> from_crossing(const TouchPlan& plan, std::span<const Vec3> balls) {
  std::vector<Vec3> placed;
  for (const Vec3& ball : balls) placed.push_back(ball + plan.table_offset);
  return placed;
}

}  // namespace

std::vector<kinematics::AxisPositions> ball_poses(const TouchPlan& plan) {
  std::vector<kinematics::AxisPositions> poses;
  for (const TablePosition& tilt : plan.tilts) {
    for (const TablePosition& turn : plan.turns) {
      kinematics::AxisPositions q;
      q[AxisLetter::A] = tilt.axis;
      q[AxisLetter::C] = turn.axis;
      poses.push_back(q);
    }
  }
  return poses;
}

Result<TableMaps> maps_of_balls(const TouchPlan& plan, std::span<const Vec3> balls,
                                const std::vector<std::vector<Vec3>>& readings) {
  if (auto problem = in_line(balls)) return *std::move(problem);
  const std::vector<Vec3> placed = from_crossing(plan, balls);
  PoseGrid poses(plan.tilts.size(),
                 std::vector<ErrorVector>(plan.turns.size(), ErrorVector::Zero()));
  std::size_t at = 0;
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    for (std::size_t j = 0; j < plan.turns.size(); ++j, ++at) {
      if (at == 0) continue;  // zero: the gauge
      const Mat3 rotation = plan.tilts[i].rotation * plan.turns[j].rotation;
      Eigen::VectorXd off(static_cast<Eigen::Index>(3 * balls.size()));
      for (std::size_t k = 0; k < balls.size(); ++k) {
        off.segment<3>(static_cast<Eigen::Index>(3 * k)) =
            -(rotation * (readings[k][at] - readings[k][0]));
      }
      poses[i][j] = estimator_of(rotation, placed) * off;
    }
  }
  return maps_of_poses(plan, std::move(poses));
}

Eigen::MatrixXd reading_model(const TouchPlan& plan, std::span<const Vec3> balls) {
  const std::vector<Vec3> placed = from_crossing(plan, balls);
  const auto count = static_cast<Eigen::Index>(balls.size());
  const auto poses = static_cast<Eigen::Index>(plan.tilts.size() * plan.turns.size());
  Eigen::MatrixXd model = Eigen::MatrixXd::Zero(3 * count * poses, 3 * count + 6 * (poses - 1));
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Index at = 0;
    for (const TablePosition& tilt : plan.tilts) {
      for (const TablePosition& turn : plan.turns) {
        const Eigen::Index row = 3 * (k * poses + at);
        model.block<3, 3>(row, 3 * k) = Mat3::Identity();
        if (at > 0) {
          const Mat3 rotation = tilt.rotation * turn.rotation;
          const Vec3 p = rotation * placed[static_cast<std::size_t>(k)];
          const Eigen::Index column = 3 * count + 6 * (at - 1);
          model.block<3, 3>(row, column) = -rotation.transpose();
          model.block<3, 3>(row, column + 3) = rotation.transpose() * cross_matrix(p);
        }
        ++at;
      }
    }
  }
  return model;
}

Result<TableMaps> deviations_of_balls(const TouchPlan& plan, std::span<const Vec3> balls,
                                      double noise) {
  const std::size_t count = plan.tilts.size() * plan.turns.size();
  std::vector<std::vector<Vec3>> readings(balls.size(), std::vector<Vec3>(count, Vec3::Zero()));
  auto sum = maps_of_balls(plan, balls, readings);
  if (!sum) return sum.error();
  const auto add = [](ErrorVector& to, const ErrorVector& v) { to += v.cwiseAbs2(); };
  // The maps are linear in the readings.
  for (auto& ball : readings) {
    for (Vec3& reading : ball) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        reading = Vec3::Unit(k);
        const auto response = maps_of_balls(plan, balls, readings);
        if (!response) return response.error();
        for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
          add(sum->tilt[i], response->tilt[i]);
          for (std::size_t j = 0; j < plan.turns.size(); ++j) {
            add(sum->turn[i][j], response->turn[i][j]);
            add(sum->poses[i][j], response->poses[i][j]);
          }
        }
        reading.setZero();
      }
    }
  }
  const auto rooted = [noise](ErrorVector& v) { v = noise * v.cwiseSqrt(); };
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    rooted(sum->tilt[i]);
    for (std::size_t j = 0; j < plan.turns.size(); ++j) {
      rooted(sum->turn[i][j]);
      rooted(sum->poses[i][j]);
    }
  }
  return sum;
}

}  // namespace frustum::instruments

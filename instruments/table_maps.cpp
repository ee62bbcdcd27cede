#include "instruments/table_maps.hpp"

#include <array>

#include "core/linear_algebra.hpp"
#include "kinematics/model/joint_motion.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using Grid = std::vector<std::vector<ErrorVector>>;

Grid zero_grid(const TouchPlan& plan) {
  return Grid(plan.tilts.size(), std::vector<ErrorVector>(plan.turns.size(), ErrorVector::Zero()));
}

// Translations and rotations turn alike.
ErrorVector turned(const Mat3& rotation, const ErrorVector& v) {
  ErrorVector out;
  out << rotation * v.head<3>(), rotation * v.tail<3>();
  return out;
}

// The touches of one pose, by their place in the plan.
struct PoseTouches {
  std::size_t tilt = 0;
  std::size_t turn = 0;
  std::vector<std::size_t> at{};
};

std::vector<PoseTouches> by_pose(const TouchPlan& plan) {
  std::vector<PoseTouches> poses;
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PlannedTouch& touch = plan.touches[t];
    if (poses.empty() || poses.back().tilt != touch.tilt || poses.back().turn != touch.turn) {
      poses.push_back({.tilt = touch.tilt, .turn = touch.turn});
    }
    poses.back().at.push_back(t);
  }
  return poses;
}

// By point, the place in the plan of its touch where both axes are zero.
std::array<std::size_t, kTouchPoints> reference_touches(const TouchPlan& plan) {
  std::array<std::size_t, kTouchPoints> at{};
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const PlannedTouch& touch = plan.touches[t];
    if (touch.tilt == 0 && touch.turn == 0) at.at(touch.point) = t;
  }
  return at;
}

// Six rows, a column a touch: what the gap of each touch along its normal adds to the pose. The
// points are where `reference` readings saw them at zero.
Eigen::MatrixXd pose_estimator(const TouchPlan& plan, const PoseTouches& pose,
                               std::span<const double> reference) {
  const auto count = static_cast<Eigen::Index>(pose.at.size());
  Eigen::MatrixXd rows(count, 6);
  for (Eigen::Index r = 0; r < count; ++r) {
    const PlannedTouch& touch = plan.touches[pose.at[static_cast<std::size_t>(r)]];
    const Mat3 rotation = plan.rotation(touch);
    const TouchPoint& point = touch_points().at(touch.point);
    const Vec3 n = rotation * point.normal;
    const Vec3 p = rotation * (point.place + reference[touch.point] * point.normal);
    rows.row(r) << n.transpose(), p.cross(n).transpose();
  }
  const Eigen::MatrixXd transposed = rows.transpose();
  return SymmetricFactors(transposed * rows).solve(transposed);
}

}  // namespace

TableMaps maps_of_poses(const TouchPlan& plan, std::vector<std::vector<ErrorVector>> poses) {
  TableMaps maps{.poses = std::move(poses)};
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    ErrorVector mean = ErrorVector::Zero();
    for (const ErrorVector& pose : maps.poses[i]) {
      mean += pose / static_cast<double>(plan.turns.size());
    }
    const Mat3 back = plan.tilts[i].rotation.transpose();
    std::vector<ErrorVector>& of_turn = maps.turn.emplace_back();
    for (const ErrorVector& pose : maps.poses[i]) of_turn.push_back(turned(back, pose - mean));
    maps.tilt.push_back(mean);
  }
  return maps;
}

TableMaps identified_maps(const TouchPlan& plan, std::span<const double> readings) {
  const auto reference_at = reference_touches(plan);
  std::array<double, kTouchPoints> reference{};
  for (std::size_t k = 0; k < kTouchPoints; ++k) reference.at(k) = readings[reference_at.at(k)];
  Grid poses = zero_grid(plan);
  for (const PoseTouches& pose : by_pose(plan)) {
    if (pose.tilt == 0 && pose.turn == 0) continue;  // zero: the gauge
    Eigen::VectorXd gaps(static_cast<Eigen::Index>(pose.at.size()));
    for (std::size_t r = 0; r < pose.at.size(); ++r) {
      const std::size_t t = pose.at[r];
      gaps[static_cast<Eigen::Index>(r)] = readings[t] - reference.at(plan.touches[t].point);
    }
    poses[pose.tilt][pose.turn] = pose_estimator(plan, pose, reference) * gaps;
  }
  return maps_of_poses(plan, std::move(poses));
}

Eigen::MatrixXd reading_model(const TouchPlan& plan) {
  const std::vector<PoseTouches> poses = by_pose(plan);
  constexpr auto kOfPoints = static_cast<Eigen::Index>(kTouchPoints);
  const auto others = static_cast<Eigen::Index>(poses.size()) - 1;
  Eigen::MatrixXd model =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(plan.touches.size()), kOfPoints + 6 * others);
  Eigen::Index column = kOfPoints;
  for (const PoseTouches& pose : poses) {
    const bool at_zero = pose.tilt == 0 && pose.turn == 0;
    for (const std::size_t t : pose.at) {
      const PlannedTouch& touch = plan.touches[t];
      const auto row = static_cast<Eigen::Index>(t);
      model(row, static_cast<Eigen::Index>(touch.point)) = 1.0;
      if (at_zero) continue;
      const Mat3 rotation = plan.rotation(touch);
      const Vec3 n = rotation * touch_points().at(touch.point).normal;
      const Vec3 p = rotation * touch_points().at(touch.point).place;
      model.row(row).segment<3>(column) = n;
      model.row(row).segment<3>(column + 3) = p.cross(n);
    }
    if (!at_zero) column += 6;
  }
  return model;
}

TableMaps standard_deviations(const TouchPlan& plan, double noise) {
  constexpr std::array<double, kTouchPoints> kNominal{};
  const auto reference_at = reference_touches(plan);
  // By touch, what noise of one there makes of every map: the maps are linear in the touches.
  const std::vector<PoseTouches> all = by_pose(plan);
  std::vector<Grid> responses(plan.touches.size(), zero_grid(plan));
  for (const PoseTouches& pose : all) {
    if (pose.tilt == 0 && pose.turn == 0) continue;
    const Eigen::MatrixXd estimator = pose_estimator(plan, pose, kNominal);
    for (std::size_t r = 0; r < pose.at.size(); ++r) {
      const std::size_t t = pose.at[r];
      const ErrorVector response = estimator.col(static_cast<Eigen::Index>(r));
      responses[t][pose.tilt][pose.turn] += response;
      responses[reference_at.at(plan.touches[t].point)][pose.tilt][pose.turn] -= response;
    }
  }
  TableMaps sd = maps_of_poses(plan, zero_grid(plan));
  const auto add_square = [](ErrorVector& sum, const ErrorVector& v) { sum += v.cwiseAbs2(); };
  for (Grid& response : responses) {
    const TableMaps maps = maps_of_poses(plan, std::move(response));
    for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
      add_square(sd.tilt[i], maps.tilt[i]);
      for (std::size_t j = 0; j < plan.turns.size(); ++j) {
        add_square(sd.turn[i][j], maps.turn[i][j]);
        add_square(sd.poses[i][j], maps.poses[i][j]);
      }
    }
  }
  const auto rooted = [noise](ErrorVector& sum) { sum = noise * sum.cwiseSqrt(); };
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    rooted(sd.tilt[i]);
    for (std::size_t j = 0; j < plan.turns.size(); ++j) {
      rooted(sd.turn[i][j]);
      rooted(sd.poses[i][j]);
    }
  }
  return sd;
}

TableMaps visible_maps(const kinematics::Machine& machine,
                       const kinematics::GeometricErrors& errors, const TouchPlan& plan,
                       std::span<const TestPose> poses) {
  const bool on_rotor = machine.rotary_error_frame() == kinematics::RotaryErrorFrame::rotor;
  // Location errors stand with the stator, component errors as the machine's file says.
  const auto error_of = [&](AxisLetter axis, const kinematics::AxisState& at,
                            const Mat3& rotation) {
    const auto moving = component_errors(errors[axis], axis, at);
    ErrorVector component, location;
    component << moving.shift, moving.turn;
    location << location_shift(errors[axis]), location_turn(errors[axis]);
    return ErrorVector(location + (on_rotor ? turned(rotation, component) : component));
  };
  Grid seen = zero_grid(plan);
  for (const PoseTouches& pose : by_pose(plan)) {
    const kinematics::AxisState& at = poses[pose.at.front()].at;
    const Mat3& tilt = plan.tilts[pose.tilt].rotation;
    const Mat3& turn = plan.turns[pose.turn].rotation;
    seen[pose.tilt][pose.turn] =
        error_of(AxisLetter::A, at, tilt) + turned(tilt, error_of(AxisLetter::C, at, turn));
  }
  const ErrorVector at_zero = seen[0][0];
  for (std::size_t i = 0; i < plan.tilts.size(); ++i) {
    for (std::size_t j = 0; j < plan.turns.size(); ++j) {
      const Mat3 rotation = plan.tilts[i].rotation * plan.turns[j].rotation;
      seen[i][j] -= turned(rotation, at_zero);
    }
  }
  return maps_of_poses(plan, std::move(seen));
}

}  // namespace frustum::instruments

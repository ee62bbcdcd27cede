#include "calibration/design/planned_piece.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "metrology/plan/strategy.hpp"
#include "programs/contour/contour_piece.hpp"
#include "tests/calibration/step_patterns.hpp"
#include "trials/surface_gain.hpp"

namespace frustum::calibration {
namespace {

constexpr double kE0 = 0.5e-3, kPerUm = 600.0;  // mm, mm per um

struct Planned {
  kinematics::Machine machine;
  PlannedPiece piece{};
  std::vector<Unknown> unknowns{};
  std::vector<Cause> causes{};
};

Planned small_contour() {
  Planned p{*kinematics::Machine::load(FRUSTUM_SOURCE_DIR "/machines/zx-yac.toml")};
  programs::ContourPiece contour{.size = {60.0}};
  contour.center = Vec3(20.0, -10.0, 120.0);
  p.piece.piece.name = "contour";
  p.piece.piece.piece = *programs::contour_piece(contour, p.machine);
  p.piece.piece.cmm = metrology::CmmModel{};
  p.piece.piece.cmm->e0_mm = kE0;
  p.piece.piece.cmm->length_per_error = kPerUm;
  for (const std::string name : {"gamma_YX", "alpha_ZY", "beta_CA", "dx_AY", "dy_CA"}) {
    const auto parameter = *trials::Parameter::named(p.machine, name);
    p.unknowns.push_back({.name = name, .angular = parameter.angular});
    p.causes.push_back({parameter, std::nullopt});
  }
  p.unknowns.push_back({.name = "radius of contour"});
  p.causes.push_back({{std::string(trials::kToolRadius), false, std::nullopt}, 3});
  return p;
}

// The information of all points by a covariance of all of them: noise, field, and a placement that
// nobody knows to 1 mm and 10 mrad.
Eigen::MatrixXd dense_information(const Planned& p, bool is_floating) {
  programs::TestPiece piece = p.piece.piece.piece;
  piece.plan.alignment = metrology::Alignment::plan;
  piece.plan.characteristics.clear();
  const auto trial = *trials::run_trial(p.machine, kinematics::GeometricErrors{}, piece, {});
  std::vector<trials::Parameter> parameters;
  for (const Cause& cause : p.causes) parameters.push_back(cause.parameter);
  const Eigen::MatrixXd gain = trials::surface_gains(p.machine, piece, trial, parameters)->odd;
  const Eigen::Index n = gain.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n) * std::pow(0.5 * kE0, 2);
  std::vector<Vec3> place, normal;
  for (const auto& feature : trial.measurement.features) {
    for (const auto& point : feature.points) {
      place.push_back(point.point);
      normal.push_back(point.normal);
    }
  }
  const auto add = [&](double sd, const auto& moved) {
    Eigen::VectorXd along(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      along[i] = sd * normal[k].dot(moved(place[k]));
    }
    covariance += along * along.transpose();
  };
  // 1 um in 600 mm is the limit of two standard deviations.
  const double scale = 0.5 * 1e-3 / kPerUm;
  for (int axis = 0; axis < 3; ++axis) {
    for (int by = axis; by < 3; ++by) {
      add(scale, [&](const Vec3& at) -> Vec3 { return Vec3::Unit(axis) * at[by]; });
    }
    if (!is_floating) continue;
    add(1.0, [&](const Vec3&) -> Vec3 { return Vec3::Unit(axis); });
    add(1e-2, [&](const Vec3& at) -> Vec3 { return Vec3::Unit(axis).cross(at); });
  }
  return gain.transpose() * covariance.llt().solve(gain);
}

TEST(PlannedPiece, KeepsTheInformationOfAllPointsInAFewRows) {
  Planned p = small_contour();
  Eigen::VectorXd size(6);
  for (Eigen::Index k = 0; k < 6; ++k)
    size[k] = p.unknowns[static_cast<std::size_t>(k)].angular ? 30e-6 : 15e-3;
  for (const PlannedRows rows : {PlannedRows::points, PlannedRows::floating_points}) {
    p.piece.rows = rows;
    const auto found = planned_observations(p.machine, p.piece, 3, p.unknowns, p.causes);
    ASSERT_TRUE(found) << found.error().front().message;
    EXPECT_LE(found->observations.rows.size(), 6U);
    EXPECT_EQ(found->touches, 360U + 12U * 49U);
    const Eigen::MatrixXd& gain = found->observations.gain;
    const Eigen::MatrixXd own = size.asDiagonal() * gain.transpose() * gain * size.asDiagonal();
    const Eigen::MatrixXd dense = size.asDiagonal() *
                                  dense_information(p, rows == PlannedRows::floating_points) *
                                  size.asDiagonal();
    EXPECT_LT((own - dense).cwiseAbs().maxCoeff(), 2e-5 * dense.cwiseAbs().maxCoeff());
    // Of a workpiece that is anywhere nothing tells where the table's axis is.
    if (rows == PlannedRows::floating_points) {
      EXPECT_LT(dense(3, 3), 1e-3 * own(0, 0));
    }
  }
}

TEST(PlannedPiece, TheRadiusOfAnotherPieceDoesNothing) {
  Planned p = small_contour();
  p.piece.rows = PlannedRows::points;
  const auto found = planned_observations(p.machine, p.piece, 2, p.unknowns, p.causes);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->observations.gain.col(5).cwiseAbs().maxCoeff(), 0.0);
  p.piece.piece.cmm.reset();
  const auto unsaid = planned_observations(p.machine, p.piece, 2, p.unknowns, p.causes);
  ASSERT_FALSE(unsaid);
  EXPECT_EQ(unsaid.error().front().id.text(), "no-uncertainty");
}

}  // namespace
}  // namespace frustum::calibration

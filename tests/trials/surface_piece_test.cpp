// Surfaces of users through NC text, cut and CMM.
#include "programs/surface/surface_piece.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinematics/errors/error_shape.hpp"
#include "tests/trials/step_trial.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

SplineSurface freeform() {
  std::vector<Vec3> net;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double x = 30.0 - 12.0 * j, y = 10.0 * i - 20.0;
      net.emplace_back(x, y, 5.0 + 0.004 * x * x - 0.003 * x * y);
    }
  }
  return {net, 6};
}

SplineSurface ruled() {
  std::vector<Vec3> low, high;
  for (int j = 0; j < 7; ++j) {
    const double x = 10.0 * j - 30.0;
    low.emplace_back(x, 0.004 * x * x, 0.0);
    high.emplace_back(x + 1.0, 2.0 + 0.006 * x * x, 20.0);
  }
  return SplineSurface::ruled(low, high);
}

Trial cut(const programs::SurfacePiece& wanted, const std::string& error = {}) {
  const kinematics::Machine machine = step_machine();
  const auto piece = programs::surface_piece(wanted, machine);
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  std::vector<kinematics::ErrorEntry> errors;
  if (!error.empty()) errors.push_back(*kinematics::parse_error(error));
  TrialOptions options;
  options.find_collisions = false;
  auto trial = run_trial(machine, errors, *piece, metrology::CmmModel{}, options);
  EXPECT_TRUE(trial) << (trial ? "" : to_string(trial.error().front()));
  return *trial;
}

TEST(SurfacePiece, AFreeformSurfaceOfAPerfectMachineIsPerfectOnItsPasses) {
  programs::SurfacePiece wanted{.surface = freeform()};
  wanted.cusp = {0.02};
  wanted.blocks = 600;
  const Trial trial = cut(wanted);
  EXPECT_NEAR(trial.measurement.characteristics.front().value, 0.0, 0.2);
  EXPECT_EQ(trial.measurement.features.size(), 105u);
}

TEST(SurfacePiece, ARuledSurfaceLeavesWhatItsMethodLeaves) {
  programs::SurfacePiece wanted{.surface = ruled()};
  wanted.cutter = Mm{12.0};
  const Trial trial = cut(wanted);
  const auto piece = programs::surface_piece(wanted, step_machine());
  const auto& lines =
      std::get<metrology::SurfaceLineStrategy>(piece->plan.features.front().strategy);
  const auto& points = trial.measurement.features.front().points;
  ASSERT_EQ(points.size(), lines.geometric.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR((points[i].deviation - lines.geometric[i]) * kUmPerMm, 0.0, 0.1) << i;
  }
}

TEST(SurfacePiece, ATableAxisOutOfPlaceShowsAsMuchAsNormalsLean) {
  programs::SurfacePiece wanted{.surface = freeform()};
  wanted.cusp = {0.05};
  const double perfect = cut(wanted).measurement.characteristics.front().value;
  const double raised = cut(wanted, "dz_AY=20um").measurement.characteristics.front().value;
  EXPECT_LT(perfect, 1.0);
  EXPECT_NEAR(raised, 40.0, 2.0);
}

}  // namespace
}  // namespace frustum::trials

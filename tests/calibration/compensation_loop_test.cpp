// The whole loop: a machine with errors cuts and is measured, its errors are identified, the
// programs compensated for them, and a second cut measured.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/compensate/compensated_piece.hpp"
#include "calibration/identify/piece_observations.hpp"
#include "calibration/identify/refinement.hpp"
#include "core/random.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "programs/step/step_pattern.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

Machine shipped(const std::string& name) {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  EXPECT_TRUE(machine);
  return *std::move(machine);
}

metrology::CmmModel laboratory_cmm(std::uint32_t draw) {
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.5e-3;
  cmm.length_per_error = 600.0;
  cmm.seed = 4711;
  cmm.draw = draw;
  return cmm;
}

struct NamedValue {
  const char* name;
  double value;  // mm or rad
};
// A machine after a collision: every location error well above what a CMM sees.
constexpr NamedValue kTruth[] = {{"alpha_AY", 45e-6},  {"beta_AY", -60e-6}, {"gamma_AY", 35e-6},
                                 {"beta_CA", 50e-6},   {"dx_AY", 12e-3},    {"dy_AY", -18e-3},
                                 {"dz_AY", 15e-3},     {"dy_CA", -10e-3},   {"gamma_YX", 70e-6},
                                 {"alpha_ZY", -40e-6}, {"beta_ZX", 55e-6}};

GeometricErrors errors_from_values(const Machine& machine, const Eigen::VectorXd& values) {
  GeometricErrors errors;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const auto parameter = trials::Parameter::named(machine, kTruth[k].name);
    errors = errors.plus(*parameter->unit, values[k]);
  }
  return errors;
}

Eigen::VectorXd true_values() {
  Eigen::VectorXd values(std::size(kTruth));
  for (Eigen::Index k = 0; k < values.size(); ++k) values[k] = kTruth[k].value;
  return values;
}

std::vector<programs::TestPiece> step_workpieces(const Machine& machine) {
  std::vector<programs::TestPiece> pieces;
  for (const auto& [number, patterns] :
       {std::pair<int, std::vector<std::string>>{1, {}}, {2, {}}, {2, {"4"}}}) {
    programs::StepTest test;
    test.workpiece = *programs::step_workpiece(number);
    test.patterns = patterns;
    auto made = programs::step_pattern(test, machine);
    EXPECT_TRUE(made);
    pieces.push_back(made->piece);
  }
  return pieces;
}

metrology::Measurement cut_and_measured(const Machine& machine, const GeometricErrors& errors,
                                        const programs::TestPiece& piece,
                                        const metrology::CmmModel& cmm) {
  trials::TrialOptions options;
  options.find_collisions = false;
  auto trial = trials::run_trial(machine, errors, piece, cmm, options);
  EXPECT_TRUE(trial) << (trial ? "" : to_string(trial.error().front()));
  return trial ? trial->measurement : metrology::Measurement{};
}

Eigen::VectorXd identified(const Machine& machine, const GeometricErrors& errors,
                           const std::vector<programs::TestPiece>& pieces) {
  std::vector<MeasuredPiece> measured;
  std::vector<Unknown> unknowns;
  std::vector<Cause> causes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    MeasuredPiece piece;
    piece.name = "workpiece " + std::to_string(i + 1);
    piece.piece = pieces[i];
    piece.cmm = laboratory_cmm(0);
    MeasuredPart part;
    const auto measurement =
        cut_and_measured(machine, errors, pieces[i], laboratory_cmm(static_cast<std::uint32_t>(i)));
    for (const auto& c : measurement.characteristics) {
      part.emplace(c.name, MeasuredValue{metrology::internal_value(c), {}});
    }
    piece.parts = {part};
    measured.push_back(std::move(piece));
  }
  for (const NamedValue& error : kTruth) {
    const auto parameter = trials::Parameter::named(machine, error.name);
    causes.push_back({*parameter, std::nullopt});
    unknowns.push_back({.name = error.name, .angular = error.value * error.value < 1e-7});
  }
  // What a laboratory knows beforehand of the squareness, which shifts with the workpiece's own
  // faces.
  for (std::size_t k = 8; k < unknowns.size(); ++k) {
    constexpr double kKnown = 5e-6;  // rad
    unknowns[k].prior = Prior{kTruth[k].value + kKnown * normal({.seed = 4712}, k), kKnown};
  }
  const auto observations = observations_of(machine, measured, unknowns, causes);
  EXPECT_TRUE(observations);
  const auto settled = refine(observations->observations, observations->model);
  EXPECT_TRUE(settled);
  return settled->identification.working_point;
}

TEST(CompensationLoopSystem, StepPatternsShrinkToWhatTheCmmCannotTell) {
  const Machine machine = shipped("zx-yac");
  const GeometricErrors errors = errors_from_values(machine, true_values());
  const auto pieces = step_workpieces(machine);
  const GeometricErrors found = errors_from_values(machine, identified(machine, errors, pieces));
  int larger_before = 0, beyond_the_table = 0, count = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto second = compensated_piece(machine, found, pieces[i]);
    ASSERT_TRUE(second) << to_string(second.error().front());
    EXPECT_LT(second->after.tip, std::max(5e-5, 0.01 * second->before.tip));
    const auto cmm = laboratory_cmm(static_cast<std::uint32_t>(10 + i));
    const auto before = cut_and_measured(machine, errors, pieces[i], cmm);
    const auto after = cut_and_measured(machine, errors, second->piece, cmm);
    const auto perfect = cut_and_measured(machine, {}, pieces[i], {});
    // With its axis level the table cannot tilt about Y: that much of the tool's tilt stays, and
    // lowers the rim of an end mill that feeds in this direction.
    const auto ideal = compensated_piece(machine, errors, pieces[i]);
    ASSERT_TRUE(ideal);
    const auto left = cut_and_measured(machine, errors, ideal->piece, {});
    for (std::size_t k = 0; k < after.characteristics.size(); ++k) {
      const auto& c = after.characteristics[k];
      const double nominal = perfect.characteristics[k].value;
      // Two uncertainties: that of the errors identified and that of the second measurement.
      const double tilt_left = left.characteristics[k].value - nominal;
      EXPECT_LT(std::abs(tilt_left), c.unit == "um" ? 1.0 : 25.0) << c.name;
      beyond_the_table += std::abs(tilt_left) > c.expanded_uncertainty;
      EXPECT_LT(std::abs(c.value - nominal - tilt_left), 2.0 * c.expanded_uncertainty)
          << c.name << " U " << c.expanded_uncertainty;
      larger_before +=
          std::abs(before.characteristics[k].value - nominal) > 2.0 * c.expanded_uncertainty;
      ++count;
    }
  }
  EXPECT_GT(larger_before, count / 2);
  EXPECT_LE(beyond_the_table, 8);
}

// What the step patterns identify of the machine corrects another part.
TEST(CompensationLoopSystem, TheInclinedConeShrinksToWhatTheCmmCannotTell) {
  const Machine machine = shipped("zx-yac");
  const GeometricErrors errors = errors_from_values(machine, true_values());
  const GeometricErrors found =
      errors_from_values(machine, identified(machine, errors, step_workpieces(machine)));
  programs::ConeFrustum cone;
  const auto piece = programs::cone_frustum(cone, machine);
  ASSERT_TRUE(piece) << to_string(piece.error().front());
  const auto second = compensated_piece(machine, found, *piece);
  ASSERT_TRUE(second) << to_string(second.error().front());
  const auto cmm = laboratory_cmm(30);
  const auto before = cut_and_measured(machine, errors, *piece, cmm);
  const auto after = cut_and_measured(machine, errors, second->piece, cmm);
  const auto perfect = cut_and_measured(machine, {}, *piece, cmm);
  bool seen = false;
  for (std::size_t k = 0; k < after.characteristics.size(); ++k) {
    const auto& c = after.characteristics[k];
    // The same noise on a perfect part: forms are never below it.
    EXPECT_LT(std::abs(c.value - perfect.characteristics[k].value), c.expanded_uncertainty)
        << c.name;
    if (c.name != "cone.equivalent_form") continue;
    seen = true;
    EXPECT_GT(before.characteristics[k].value, 5.0 * perfect.characteristics[k].value);
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace frustum::calibration

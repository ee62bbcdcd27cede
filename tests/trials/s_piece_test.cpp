// The S-shaped piece through NC text, cut and CMM, against an independent computation from the
// distances of points to all axes of the cutter.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "kinematics/errors/error_shape.hpp"
#include "metrology/plan/strategy.hpp"
#include "programs/s_piece/s_piece.hpp"
#include "tests/law_count.hpp"
#include "tests/trials/step_trial.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

using Effects = Eigen::VectorXd;  // um, points of A, then of B

// A shipped machine whose axes have these gains (1/s): of one axis, and of all others.
kinematics::Machine machine_with_gain(const std::string& name, char axis, double gain,
                                      double others) {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string toml = text.str();
  for (const char each : std::string("XYZABC")) {
    const std::size_t table = toml.find(std::string("[axis.") + each + "]");
    if (table == std::string::npos) continue;
    const std::size_t value = toml.find('=', toml.find("servo_gain", table));
    toml.replace(value, toml.find('\n', value) - value,
                 "= " + std::to_string(each == axis ? gain : others));
  }
  const auto machine = kinematics::Machine::read(toml, name);
  EXPECT_TRUE(machine) << (machine ? "" : to_string(machine.error().front()));
  return *machine;
}
kinematics::Machine shipped_machine(const std::string& name) {
  return *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name +
                                    ".toml");
}

programs::TestPiece piece_on(const kinematics::Machine& machine,
                             const programs::SPiece& wanted = {}) {
  auto piece = programs::s_piece(wanted, machine);
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  return *piece;
}

Trial cut(const kinematics::Machine& machine, const programs::TestPiece& piece,
          const std::string& error = {}, bool lags = false) {
  std::vector<kinematics::ErrorEntry> errors;
  if (!error.empty()) {
    const auto entry = kinematics::parse_error(error);
    EXPECT_TRUE(entry) << error;
    errors.push_back(*entry);
  }
  TrialOptions options;
  options.find_collisions = false;
  options.servo_lag = lags;
  auto trial = run_trial(machine, errors, piece, metrology::CmmModel{}, options);
  EXPECT_TRUE(trial) << error << (trial ? "" : to_string(trial.error().front()));
  return *trial;
}

Effects deviations(const Trial& trial) {
  Effects all(294);
  Eigen::Index row = 0;
  for (const auto& feature : trial.measurement.features) {
    for (const auto& p : feature.points) all[row++] = p.deviation * kUmPerMm;
  }
  EXPECT_EQ(row, 294);
  return all;
}

// What a rigid motion of all points cannot take up.
Effects floating(const programs::TestPiece& piece, const Effects& effects) {
  Eigen::MatrixXd motions(effects.size(), 6);
  Eigen::Index row = 0;
  for (const auto& feature : piece.plan.features) {
    for (const auto& p : metrology::planned_points(feature)) {
      motions.row(row).head<3>() = p.normal;
      motions.row(row++).tail<3>() = p.point.cross(p.normal) / 100.0;
    }
  }
  return effects - motions * motions.colPivHouseholderQr().solve(effects);
}
double largest(const Effects& effects) { return effects.cwiseAbs().maxCoeff(); }
double rms(const Effects& effects) {
  return effects.norm() / std::sqrt(static_cast<double>(effects.size()));
}

// A surface of deviations is compared as a whole.
void compare(const programs::TestPiece& piece, const Effects& effects,
             const nlohmann::json& expected, double within, double share, const std::string& name) {
  // The axis of each machine that reverses 0.2 mm beside a point: what is there depends on where
  // blocks end, and the fit with it. 0.0303 um are left (docs/verification.md).
  const auto is_beside_a_jump = [](const std::string& of) {
    return of == "zx-yac EYY reversal" || of == "iwf-bc EXX reversal";
  };
  const auto near = [&](double value, const char* key) {
    const double want = expected[key];
    EXPECT_NEAR(value, want, std::max(within, share * std::abs(want))) << name << " " << key;
  };
  near(largest(effects), "max");
  near(rms(effects), "rms");
  const Effects free = floating(piece, effects);
  if (expected.contains("floating_max")) {
    if (is_beside_a_jump(name)) {
      EXPECT_NEAR(largest(free), expected["floating_max"], 0.031) << name;
    } else {
      near(largest(free), "floating_max");
    }
    near(rms(free), "floating_rms");
  }
  for (const auto& [key, first] : {std::pair{"at_A_15", 49}, {"at_B_15", 147 + 49}}) {
    if (!expected.contains(key)) continue;
    for (std::size_t k = 0; k < expected[key].size(); ++k) {
      EXPECT_NEAR(effects[first + 8 * static_cast<int>(k)], expected[key][k].get<double>(), within)
          << name << " " << key << " " << k;
    }
  }
}

class SPieceReference : public testing::TestWithParam<const char*> {
 protected:
  nlohmann::json expected_ = test_data("s_piece.json")["s_machines"][GetParam()];
};

TEST_P(SPieceReference, LocationErrorsActAsOnAnIndependentCut) {
  const kinematics::Machine machine = shipped_machine(GetParam());
  const programs::TestPiece piece = piece_on(machine);
  std::vector<std::string> names;
  for (const auto& [name, of] : expected_["location"].items()) names.push_back(name);
  const auto parameters = parameters_named(machine, names);
  ASSERT_TRUE(parameters) << to_string(parameters.error().front());
  const Trial trial = cut(machine, piece);
  const auto gains = surface_gains(machine, piece, trial, *parameters);
  ASSERT_TRUE(gains) << to_string(gains.error().front());
  for (std::size_t k = 0; k < names.size(); ++k) {
    // Gains are in mm per mm or rad: in um, 10 um or 10 urad make so much.
    const double amount = (*parameters)[k].angular ? 1e-5 * kUmPerMm : 10.0;
    compare(piece, amount * gains->odd.col(static_cast<Eigen::Index>(k)),
            expected_["location"][names[k]], 0.03, 0.0, names[k]);
  }
}

TEST_P(SPieceReference, AnErrorOfTheWholeCutIsThatOfFirstOrder) {
  const kinematics::Machine machine = shipped_machine(GetParam());
  const programs::TestPiece piece = piece_on(machine);
  const Effects perfect = deviations(cut(machine, piece));
  const bool is_zx = std::string(GetParam()) == "zx-yac";
  const std::vector<std::string> names =
      is_zx ? std::vector<std::string>{"alpha_AY", "dx_AY", "gamma_YX"}
            : std::vector<std::string>{"EB0C", "EX0B", "EC0Y"};
  for (const std::string& name : names) {
    const bool angular = expected_["location"][name]["amount"] == "10 urad";
    const Effects effects =
        deviations(cut(machine, piece, name + (angular ? "=10urad" : "=10um"))) - perfect;
    compare(piece, effects, expected_["location"][name], 0.03, 0.0, name);
  }
}

TEST_P(SPieceReference, ReversalActsAsOnAnIndependentCut) {
  const kinematics::Machine machine = shipped_machine(GetParam());
  const programs::TestPiece piece = piece_on(machine);
  const Effects perfect = deviations(cut(machine, piece));
  for (const auto& [name, of] : expected_["reversal"].items()) {
    const std::string amount = of["amount"];
    const std::string error = name.substr(0, 3) + "=reversal " + amount.substr(0, 2) +
                              (amount.find("urad") == std::string::npos ? "um" : "urad");
    compare(piece, deviations(cut(machine, piece, error)) - perfect, of, 0.03, 0.0,
            std::string(GetParam()) + " " + name);
  }
}

TEST_P(SPieceReference, ServoLagActsAsOnAnIndependentCut) {
  const std::string tilt = std::string(GetParam()) == "zx-yac" ? "A" : "B";
  for (const auto& [name, of] : expected_["servo_600"].items()) {
    // 3 s each; all of them by make laws.
    const bool is_file = name == "machine file";
    if (proof::laws_are_reduced() && !is_file && name != "C 47.5") continue;
    const char axis = name.starts_with("tilt") ? tilt[0] : name[0];
    const bool is_equal = name == "equal 50";
    const kinematics::Machine machine =
        is_file ? shipped_machine(GetParam())
                : machine_with_gain(GetParam(), axis, is_equal ? 50.0 : 47.5, 50.0);
    const programs::TestPiece piece = piece_on(machine);
    const Effects perfect = deviations(cut(machine, piece));
    compare(piece, deviations(cut(machine, piece, {}, true)) - perfect, of, 0.3, 0.001, name);
  }
}
// How many combinations of the location errors and the tool radius the piece tells.
TEST_P(SPieceReference, SingularValuesAreThoseOfTheData) {
  const kinematics::Machine machine = shipped_machine(GetParam());
  const programs::TestPiece piece = piece_on(machine);
  std::vector<std::string> names;
  for (const auto& [name, of] : expected_["location"].items()) names.push_back(name);
  names.emplace_back(kToolRadius);
  const auto parameters = parameters_named(machine, names);
  ASSERT_TRUE(parameters);
  const auto gains = surface_gains(machine, piece, cut(machine, piece), *parameters);
  ASSERT_TRUE(gains);
  Eigen::MatrixXd columns = gains->odd;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const Parameter& parameter = (*parameters)[static_cast<std::size_t>(k)];
    // um of 30 urad, 15 um, 10 um of radius.
    columns.col(k) *= parameter.angular ? 30e-6 * kUmPerMm : parameter.unit ? 15.0 : 10.0;
  }
  Eigen::MatrixXd floated = columns;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    floated.col(k) = floating(piece, columns.col(k));
  }
  const nlohmann::json data = test_data("s_piece.json")["s_identifiability"];
  const std::string machine_name = GetParam();
  for (const auto& [matrix, kind] :
       {std::pair<Eigen::MatrixXd, const char*>{columns, " raw"}, {floated, " float"}}) {
    const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
    const nlohmann::json& expected = data[machine_name + kind];
    ASSERT_EQ(static_cast<std::size_t>(values.size()), expected.size());
    int told = 0, told_there = 0;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const double want = expected[static_cast<std::size_t>(k)];
      EXPECT_NEAR(values[k], want, 0.03 + 0.001 * want) << machine_name << kind << k;
      told += values[k] > 1.0 ? 1 : 0;
      told_there += want > 1.0 ? 1 : 0;
    }
    EXPECT_EQ(told, told_there);
  }
}
INSTANTIATE_TEST_SUITE_P(Machines, SPieceReference, testing::Values("zx-yac", "iwf-bc"));

TEST(SPiece, EachMethodLeavesWhatTheDataSays) {
  const nlohmann::json expected = test_data("s_piece.json")["s_piece"]["nominal_deviation"];
  const kinematics::Machine machine = shipped_machine("zx-yac");
  for (std::size_t k = 0; k < programs::kFlankMethodNames.size(); ++k) {
    programs::SPiece wanted;
    wanted.method = static_cast<programs::FlankMethod>(k);
    const programs::TestPiece piece = piece_on(machine, wanted);
    const Effects left = deviations(cut(machine, piece));
    const nlohmann::json& of = expected[std::string(programs::kFlankMethodNames[k])];
    for (int line = 0; line < 3; ++line) {
      for (int j = 0; j < 13; ++j) {
        const double want = of["at_points"][static_cast<std::size_t>(13 * line + j)];
        EXPECT_NEAR(left[49 * line + 4 * j], want, 0.05) << of << " " << line << " " << j;
        EXPECT_NEAR(left[147 + 49 * line + 4 * j], want, 0.05);
      }
    }
    EXPECT_NEAR(left.minCoeff(), of["min"].get<double>(), 0.05);
    EXPECT_NEAR(left.maxCoeff(), of["max"].get<double>(), 0.05);
    EXPECT_NEAR(rms(left), of["rms"].get<double>(), 0.05);
  }
}

// For other cutters, heights and places the cut leaves what the method leaves: beyond it, below
// 0.1 um.
TEST(SPiece, OfAPerfectMachineLeavesWhatTheMethodLeavesAndNoMore) {
  const struct {
    const char* machine;
    double cutter, height, orientation;
    Vec3 center;
    programs::FlankMethod method;
  } cases[] = {{"iwf-bc", 12.0, 20.0, 30.0, {-30, 40, 130}, programs::FlankMethod::three_point},
               {"zx-yac", 16.0, 40.0, -75.0, {20, -30, 110}, programs::FlankMethod::balanced},
               {"dvf5000", 20.0, 30.0, 0.0, {0, 0, 100}, programs::FlankMethod::two_point}};
  for (const auto& c : cases) {
    programs::SPiece wanted;
    wanted.cutter = {c.cutter};
    wanted.height = {c.height};
    wanted.orientation = {c.orientation * kRadPerDeg};
    wanted.center = c.center;
    wanted.method = c.method;
    const kinematics::Machine machine = shipped_machine(c.machine);
    const programs::TestPiece piece = piece_on(machine, wanted);
    const Trial trial = cut(machine, piece);
    EXPECT_TRUE(trial.wrong_cuts.empty());
    const Effects left = deviations(trial);
    Eigen::Index row = 0;
    for (const auto& feature : piece.plan.features) {
      for (const double geometric :
           std::get<metrology::SurfaceLineStrategy>(feature.strategy).geometric) {
        EXPECT_NEAR(left[row], geometric * kUmPerMm, 0.1) << c.machine << " " << row;
        ++row;
      }
    }
  }
}

// On table machines the flank is blind to machine Z, wherever the rotary axes are.
TEST(SPiece, LawTheFlankIsBlindToMotionAlongTheTool) {
  for (const char* name : {"zx-yac", "iwf-bc"}) {
    const kinematics::Machine machine = shipped_machine(name);
    const programs::TestPiece piece = piece_on(machine);
    const Effects perfect = deviations(cut(machine, piece));
    for (const char* error : {"EZZ=linear 10um over -100mm..500mm", "EZZ=reversal 10um",
                              "EZX=harmonic 1 10um over -200mm..200mm"}) {
      const Effects effects = deviations(cut(machine, piece, error)) - perfect;
      EXPECT_LT(largest(effects), 0.003) << name << " " << error;
    }
  }
}

// The floating profile is that of the whole: a rigid motion of the piece changes nothing.
TEST(SPiece, CharacteristicsAreThoseOfTheirPoints) {
  const kinematics::Machine machine = shipped_machine("zx-yac");
  const programs::TestPiece piece = piece_on(machine);
  const Trial trial = cut(machine, piece, "dy_AY=10um");
  const Effects all = deviations(trial);
  std::map<std::string, double> values;
  for (const auto& c : trial.measurement.characteristics) values[c.name] = c.value;
  EXPECT_NEAR(values.at("s.A.line_low"), 2.0 * largest(all.segment(0, 49)), 1e-9);
  EXPECT_NEAR(values.at("s.B.line_high"), 2.0 * largest(all.segment(147 + 98, 49)), 1e-9);
  EXPECT_NEAR(values.at("s.A.profile"), 2.0 * largest(all.head(147)), 1e-9);
  EXPECT_NEAR(values.at("s.profile"), 2.0 * largest(all), 1e-9);
  EXPECT_NEAR(values.at("s.profile_floating"), 2.0 * largest(floating(piece, all)), 0.01);
  EXPECT_NEAR(values.at("s.thickness_mid"),
              all.segment(49, 49).mean() + all.segment(147 + 49, 49).mean(), 1e-9);
}

TEST(SPiece, RefusesWhatCannotBeMade) {
  const kinematics::Machine machine = shipped_machine("zx-yac");
  programs::SPiece wanted;
  wanted.center = Vec3(5000.0, 0.0, 120.0);
  EXPECT_EQ(programs::s_piece(wanted, machine).error().front().id, "axis-over-travel"_id);
  wanted = {};
  wanted.feed = 0.0;
  EXPECT_EQ(programs::s_piece(wanted, machine).error().front().id, "out-of-range"_id);
  wanted = {};
  wanted.blocks = 0;
  EXPECT_EQ(programs::s_piece(wanted, machine).error().front().key, "blocks");
}

}  // namespace
}  // namespace frustum::trials

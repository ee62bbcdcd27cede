// The contouring piece through NC text, cut and CMM, against an independent computation of the
// same cuts and against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>

#include "kinematics/errors/error_shape.hpp"
#include "programs/contour/contour_piece.hpp"
#include "tests/trials/step_trial.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

using Values = std::map<std::string, double>;  // um, urad

// A shipped machine whose linear axes have these gains (1/s).
kinematics::Machine machine_with(const std::string& name, double of_x, double of_others) {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string toml = text.str();
  for (const char axis : {'X', 'Y', 'Z'}) {
    const std::size_t table = toml.find(std::string("[axis.") + axis + "]");
    const std::size_t gain = toml.find('=', toml.find("servo_gain", table));
    toml.replace(gain, toml.find('\n', gain) - gain,
                 "= " + std::to_string(axis == 'X' ? of_x : of_others));
  }
  const auto machine = kinematics::Machine::read(toml, name);
  EXPECT_TRUE(machine) << (machine ? "" : to_string(machine.error().front()));
  return *machine;
}

struct Conditions {
  std::string error{};  // as --error takes it
  double feed = 600.0;
  double gain_of_x = 0.0;  // 0: no servo lag
};

Values measured(const std::string& machine_name, double size, const Conditions& of,
                bool bore = false) {
  const bool lags = of.gain_of_x > 0.0;
  const kinematics::Machine machine = machine_with(machine_name, lags ? of.gain_of_x : 50.0, 50.0);
  programs::ContourPiece contour;
  contour.size = {size};
  contour.feed = of.feed;
  contour.bore = bore;
  const auto piece = programs::contour_piece(contour, machine);
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  std::vector<kinematics::ErrorEntry> errors;
  if (!of.error.empty()) {
    const auto entry = kinematics::parse_error(of.error);
    EXPECT_TRUE(entry) << of.error << (entry ? "" : to_string(entry.error().front()));
    errors.push_back(*entry);
  }
  TrialOptions options;
  options.find_collisions = false;
  options.servo_lag = lags;
  const auto trial = run_trial(machine, errors, *piece, metrology::CmmModel{}, options);
  EXPECT_TRUE(trial) << of.error << (trial ? "" : to_string(trial.error().front()));
  Values values;
  if (!trial) return values;
  for (const auto& c : trial->measurement.characteristics) values[c.name] = c.value;
  return values;
}

// "EXX reversal 10um", "servo X 47.5, F3000", "dx_AY"
Conditions conditions_of(const std::string& name) {
  std::smatch found;
  if (name == "nominal") return {};
  if (std::regex_match(name, found, std::regex("servo (equal|X) ([0-9.]+), F([0-9]+)"))) {
    return {{}, std::stod(found[3]), std::stod(found[2])};
  }
  const std::size_t space = name.find(' ');
  if (space != std::string::npos) {
    return {name.substr(0, space) + "=" + name.substr(space + 1)};
  }
  const bool turns = name[0] == 'a' || name[0] == 'b' || name[1] == 'A' || name[1] == 'B';
  return {name + (turns ? "=10urad" : "=10um")};
}

class ContourPieceReference : public testing::TestWithParam<const char*> {};

TEST_P(ContourPieceReference, IsAsOnAnIndependentCut) {
  const nlohmann::json data = test_data("contour_piece.json");
  for (const auto& [name, expected] : data["cases"][GetParam()].items()) {
    const Conditions of = conditions_of(name);
    const double within = of.gain_of_x > 0.0 ? 0.1 : 0.02;
    const Values values = measured(GetParam(), 160.0, of);
    for (const auto& [characteristic, value] : expected.items()) {
      ASSERT_TRUE(values.contains(characteristic)) << characteristic;
      // The data has one sign for both machines, where X carries the tool and where it carries the
      // work. Moving the tool by EYX = 10 um cos(pi x / 200 mm) lowers the slope of the side about
      // x = 4 mm by 9.2 urad, moving the work raises it.
      const bool is_other_sign = std::string(GetParam()) == "zx-yac" && name.starts_with("EYX") &&
                                 characteristic == "quad.angle_12";
      const double sign = is_other_sign ? -1.0 : 1.0;
      EXPECT_NEAR(values.at(characteristic), sign * value.get<double>(), within)
          << name << ": " << characteristic;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Machines, ContourPieceReference, testing::Values("zx-yac", "iwf-bc"));

// r radius of the circle, w distance of opposite sides, R cutter radius: what is sheared is the
// path.
TEST(ContourPiece, IsAsTheClosedFormsOfSizesThatNobodyElseHasCut) {
  for (const double size : {60.0, 100.0, 200.0}) {
    const double r = 0.28125 * size, cutter = size / 16.0;
    const double g = 20e-3;  // um per mm
    Values values = measured("zx-yac", size, {"gamma_YX=20urad"}, true);
    EXPECT_NEAR(values["circle.roundness"], g * (r + cutter), 0.02);
    EXPECT_NEAR(values["square.angle_12"], 20.0, 0.02);
    const double half_width = 0.5 * 0.4375 * size * std::numbers::sqrt2;
    EXPECT_NEAR(values["diamond.width_13"], g * (half_width + cutter), 0.02);
    EXPECT_NEAR(values["diamond.width_24"], -g * (half_width + cutter), 0.02);
    // The cutter is inside of the bore.
    EXPECT_NEAR(values["bore.roundness"], g * (0.09375 * size - cutter), 0.02);
    values = measured("zx-yac", size, {"EXX=reversal 8um"});
    EXPECT_NEAR(values["diamond.width_13"], -8.0 / std::numbers::sqrt2, 0.02);
    EXPECT_NEAR(values["quad.width_13"], -8.0 * std::cos(3.0 * std::numbers::pi / 180.0), 0.02);
    EXPECT_NEAR(values["square.width_13"], 0.0, 0.02);
  }
}

TEST(ContourPiece, OfAPerfectMachineIsPerfect) {
  for (const char* machine : {"three-axis", "swivel-head-table"}) {
    for (const auto& [name, value] : measured(machine, 120.0, {}, true)) {
      EXPECT_NEAR(value, 0.0, 0.05) << machine << ": " << name;
    }
  }
}

TEST(ContourPiece, RefusesWhatCannotBeMade) {
  const kinematics::Machine machine = machine_with("zx-yac", 50.0, 50.0);
  programs::ContourPiece piece;
  piece.size = {20.0};
  EXPECT_EQ(programs::contour_piece(piece, machine).error().front().id, "piece-size"_id);
  piece = {};
  piece.center = Vec3(500.0, 0.0, 120.0);
  EXPECT_EQ(programs::contour_piece(piece, machine).error().front().id, "axis-over-travel"_id);
  piece = {};
  piece.feed = 0.0;
  EXPECT_EQ(programs::contour_piece(piece, machine).error().front().id, "piece-feed"_id);
  piece = {};
  piece.spindle_speed = 0.0;
  EXPECT_EQ(programs::contour_piece(piece, machine).error().front().key, "speed");
  piece = {};
  piece.tool_length = {0.0};
  EXPECT_EQ(programs::contour_piece(piece, machine).error().front().key, "tool-length");
}

}  // namespace
}  // namespace frustum::trials

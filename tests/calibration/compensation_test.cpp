// Compensated programs follow the nominal path on the machine with errors.
#include "calibration/compensate/compensation.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/path/path_comparison.hpp"
#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "parser/writing/motion_writer.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "tests/kinematics/executing.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

Machine shipped_machine(const std::string& name) {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  EXPECT_TRUE(machine);
  return *std::move(machine);
}

// All location errors and one component error of each kind, as an average machine has them.
GeometricErrors errors_of(const Machine& machine) {
  std::vector<kinematics::ErrorEntry> entries;
  int k = 0;
  for (const kinematics::ErrorName& name : machine.error_names()) {
    const bool turn = kinematics::is_rotation(name.direction);
    const char* amount =
        turn ? (k % 2 == 0 ? "25urad" : "-15urad") : (k % 2 == 0 ? "8um" : "-12um");
    std::string shape = name.location ? "" : (k % 3 == 0 ? "linear " : "harmonic 2 ");
    entries.push_back(*kinematics::parse_error(name.text() + '=' + shape + amount));
    ++k;
  }
  return *kinematics::resolve(machine, entries);
}

std::vector<parser::Motion> motions_of(const std::string& text, parser::Dialect dialect) {
  const auto program = parser::parse_program(text, "test.nc", dialect);
  EXPECT_TRUE(program);
  auto motions = parser::motions_of(*program);
  EXPECT_TRUE(motions);
  return *std::move(motions);
}

struct Case {
  const char* machine;
  programs::ProgramForm form;
};
class CompensatedCone : public ::testing::TestWithParam<Case> {};

TEST_P(CompensatedCone, LeavesAtMostOnePercentOrATwentiethOfAMicrometre) {
  const Machine machine = shipped_machine(GetParam().machine);
  programs::ConeFrustum cone;
  cone.form = GetParam().form;
  const auto piece = programs::cone_frustum(cone, machine);
  ASSERT_TRUE(piece) << to_string(piece.error().front());
  const auto motions = motions_of(piece->program, piece->dialect);
  const auto result = compensated(machine, errors_of(machine), trials::setup_of(*piece), motions);
  ASSERT_TRUE(result) << to_string(result.error().front());
  EXPECT_GT(result->before.tip, 5e-3);
  EXPECT_LT(result->after.tip, std::max(5e-5, 0.01 * result->before.tip));
  EXPECT_LT(result->after.axis, 0.01 * result->before.axis);
  std::printf("%s: tip %.3f um -> %.4f um, axis %.2f urad -> %.4f urad, %zu -> %zu motions\n",
              GetParam().machine, result->before.tip * 1e3, result->after.tip * 1e3,
              result->before.axis * 1e6, result->after.axis * 1e6, motions.size(),
              result->motions.size());
}

INSTANTIATE_TEST_SUITE_P(Machines, CompensatedCone,
                         ::testing::Values(Case{"iwf-bc", programs::ProgramForm::vector},
                                           Case{"iwf-bc", programs::ProgramForm::axes},
                                           Case{"double-pivot-head", programs::ProgramForm::angles},
                                           Case{"swivel-head-table",
                                                programs::ProgramForm::vector}));

// A wavy surface milled with a leaning tool, tip and tool vectors, arcs at the turns.
std::string freeform_program() {
  std::string text = "T1 M6\nG54\nS6000 M3\nG43.5 H1\nG0 X-30 Y-20 Z40 I0 J0 K1\n";
  for (int row = 0; row <= 4; ++row) {
    for (int k = 0; k <= 40; ++k) {
      const double x = (row % 2 == 0 ? 1.0 : -1.0) * (1.5 * k - 30.0), y = 10.0 * row - 20.0;
      const double z = 3.0 * std::sin(0.12 * x) * std::cos(0.1 * y);
      const Vec3 axis =
          Vec3(0.25 + 0.15 * std::cos(0.05 * x), 0.2 * std::sin(0.07 * y), 1.0).normalized();
      text += fmt::format("G1 X{:.6f} Y{:.6f} Z{:.6f} I{:.9f} J{:.9f} K{:.9f} F900\n", x, y, z,
                          axis.x(), axis.y(), axis.z());
    }
  }
  return text + "G0 Z60\nM30\n";
}

// What is written in a dialect, read back and executed on the machine with errors.
class CompensatedInDialect
    : public ::testing::TestWithParam<std::tuple<const char*, parser::Dialect>> {};

// Largest distance of the tip beside the nominal path, mm.
double tip_left(const Machine& machine, const kinematics::Setup& setup,
                const std::vector<parser::Motion>& nominal, parser::Dialect dialect) {
  const GeometricErrors errors = errors_of(machine);
  const auto result = compensated(machine, errors, setup, nominal);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error().front()));
  const auto text = parser::write_nc(result->motions, dialect);
  EXPECT_TRUE(text) << (text ? "" : to_string(text.error().front()));
  const auto path = [&](const GeometricErrors& e, const std::vector<parser::Motion>& motions) {
    auto run = kinematics::execute(machine, e, setup, motions);
    EXPECT_TRUE(run) << (run ? "" : to_string(run.error().front()));
    return run ? run->path : kinematics::ToolPath{};
  };
  const auto matches =
      kinematics::match_paths(path({}, nominal), path(errors, motions_of(text->text, dialect)));
  EXPECT_FALSE(matches.matches.empty());
  double worst = 0.0;
  for (const auto& match : matches.matches) worst = std::max(worst, match.tip_distance());
  EXPECT_GT(result->before.tip, 5e-3);
  EXPECT_LT(worst, std::max(5e-5, 0.01 * result->before.tip));
  return worst;
}

TEST_P(CompensatedInDialect, FollowsTheNominalPathOfAFreeformProgram) {
  const auto& [name, dialect] = GetParam();
  kinematics::Setup setup;
  setup.work_offsets[1] = Vec3(20.0, -15.0, 120.0);
  setup.tools[1] = {.length = 130.0, .length_error = 0.0, .flute_length = 30.0};
  const auto nominal = motions_of(freeform_program(), parser::Dialect::fanuc);
  EXPECT_LT(tip_left(shipped_machine(name), setup, nominal, dialect), 5e-5);
}

TEST_P(CompensatedInDialect, FollowsTheNominalPathOfTheCone) {
  const auto& [name, dialect] = GetParam();
  const Machine machine = shipped_machine(name);
  programs::ConeFrustum cone;
  cone.chord_tolerance = Mm{2e-4};
  const auto piece = programs::cone_frustum(cone, machine);
  ASSERT_TRUE(piece);
  EXPECT_LT(tip_left(machine, trials::setup_of(*piece), motions_of(piece->program, piece->dialect),
                     dialect),
            5e-5);
}

INSTANTIATE_TEST_SUITE_P(
    MachinesAndDialects, CompensatedInDialect,
    ::testing::Combine(::testing::Values("iwf-bc", "double-pivot-head", "swivel-head-table"),
                       ::testing::Values(parser::Dialect::fanuc, parser::Dialect::linuxcnc,
                                         parser::Dialect::sinumerik, parser::Dialect::heidenhain)));

}  // namespace
}  // namespace frustum::calibration

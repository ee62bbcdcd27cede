// Compensated programs follow the nominal path on the machine with errors.
#include "calibration/compensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "programs/cone_frustum.hpp"
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
  const Machine machine = shipped(GetParam().machine);
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
  std::printf("%s: %.3f um -> %.4f um, %.2f urad -> %.4f urad, %zu -> %zu motions\n",
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

}  // namespace
}  // namespace frustum::calibration

// Compensation of random error sets, with harmonics and reversals, on four machines.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "calibration/compensate/compensated_piece.hpp"
#include "core/random.hpp"
#include "tests/calibration/independent_run.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/law_count.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

constexpr std::array kCompensated{"iwf-bc", "zx-yac", "double-pivot-head", "swivel-head-table"};

// Every error that the machine has, a third of them with a reversal.
std::vector<std::string> random_errors(const Machine& machine, std::uint32_t draw) {
  const RandomKey key{.seed = 2223, .draw = draw};
  std::vector<std::string> texts;
  std::uint64_t index = 0;
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * uniform(key, index++); };
  for (const kinematics::ErrorName& name : machine.error_names()) {
    const bool turn = kinematics::is_rotation(name.direction);
    const char* unit = turn ? "urad" : "um";
    const double most = turn ? 30.0 : 10.0;
    const auto amount = [&] { return fmt::format("{:.3f}{}", between(-most, most), unit); };
    std::string shape = amount();
    if (!name.location) {
      shape = between(0.0, 1.0) < 0.5 ? "linear " + shape
                                      : fmt::format("harmonic {} {}", 1 + draw % 3, shape);
      if (between(0.0, 1.0) < 0.33) shape += " + reversal " + amount();
    }
    texts.push_back(name.text() + "=" + shape);
  }
  return texts;
}

// 200 sets in all, of each machine 50.
class CompensationLaws : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(CompensationLaws, LeavesOnePercentOrATwentiethOfAMicrometreBesideTheTurnsOfAxes) {
  const char* const name = kCompensated.at(GetParam());
  const Machine machine = kinematics::shipped(name);
  const auto sets = proof::law_count<std::uint32_t>(50, 1);
  for (std::uint32_t set = 0; set < sets; ++set) {
    const std::uint32_t draw = 4 * set + GetParam();
    const auto form = draw % 3 == 0 ? programs::ProgramForm::axes : programs::ProgramForm::vector;
    const auto piece = cone_piece(machine, form, 2e-3);
    const GeometricErrors errors = errors_from(machine, random_errors(machine, draw));
    const auto made = compensated_piece(machine, errors, piece);
    ASSERT_TRUE(made) << draw << ": " << to_string(made.error().front());
    const IndependentRun anew = run_independently(machine, errors, piece, made->piece);
    std::printf(
        "%u %s: %.3f um, %.2f urad -> %.4f um, anew %.4f um; at turns %.3f um, %.2f urad, anew "
        "%.3f um, %.2f urad\n",
        draw, name, made->before.tip * 1e3, made->before.axis * 1e6, made->after.tip * 1e3,
        anew.nominal.tip * 1e3, made->at_turns.tip * 1e3, made->at_turns.axis * 1e6,
        anew.walked.tip * 1e3, anew.walked.axis * 1e6);
    std::fflush(stdout);
    EXPECT_LT(made->after.tip, allowed_residual(made->before)) << draw;
    EXPECT_NEAR(anew.nominal.tip, made->after.tip, 3e-5) << draw;
    // Nowhere is the tool farther off, and the greatest error is no less.
    const PathError worst{std::max(made->after.tip, made->at_turns.tip),
                          std::max(made->after.axis, made->at_turns.axis)};
    EXPECT_NEAR(anew.walked.tip, worst.tip, 1e-3 * worst.tip + 1e-5) << draw;
    // Axes walked along by themselves may be early or late by more than together with the tips.
    EXPECT_LT(anew.walked.axis, 1.001 * worst.axis + 1e-6) << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, CompensationLaws, ::testing::Range(0U, 4U), [](const auto& of) {
  std::string name = kCompensated.at(of.param);
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace frustum::calibration

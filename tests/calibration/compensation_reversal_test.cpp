// Compensation of errors that depend on the direction of motion, and that turn axes by correcting.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <span>

#include "calibration/compensate/compensated_piece.hpp"
#include "tests/calibration/independent_run.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/law_count.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

TEST(CompensatedReversal, Fault2_22_ProvesTheProgramThatIsWritten) {
  const std::array names{"iwf-bc", "double-pivot-head"};
  for (const char* name : std::span(names).first(proof::law_count<std::size_t>(names.size(), 1))) {
    const Machine machine = kinematics::shipped(name);
    const auto piece = cone_piece(machine, programs::ProgramForm::axes, 2e-3);
    // Z turns, B and X correct it: a reversal is a tilt of 100 urad.
    const GeometricErrors errors = errors_from(machine, {"EBZ=reversal 100urad"});
    const auto made = compensated_piece(machine, errors, piece);
    ASSERT_TRUE(made) << to_string(made.error().front());
    EXPECT_NEAR(made->before.axis, 5e-5, 1e-9) << name;
    EXPECT_LT(made->after.tip, 5e-5) << name;
    EXPECT_LT(made->after.axis, 1e-6) << name;
    // While B takes up the tilt of both directions the tool is off by all of it.
    EXPECT_NEAR(made->at_turns.axis, 1e-4, 1e-6) << name;
    const PathError anew = run_independently(machine, errors, piece, made->piece).nominal;
    EXPECT_LT(anew.tip, 5e-5) << name;
    EXPECT_LT(anew.axis, 1e-6) << name;
  }
}

TEST(CompensatedReversal, Fault2_23_FindsTheDirectionsThatItsOwnCorrectionsCause) {
  for (const auto form : {programs::ProgramForm::vector, programs::ProgramForm::axes}) {
    const Machine machine = kinematics::shipped("iwf-bc");
    const auto piece = cone_piece(machine, form, 2e-3);
    const std::array reversals{"-10um", "10um settle 0.03mm", "10um", "-10um settle 0.006mm"};
    for (const char* reversal :
         std::span(reversals).first(proof::law_count<std::size_t>(reversals.size(), 1))) {
      const GeometricErrors errors = errors_from(
          machine, {fmt::format("EXX=reversal {} + harmonic 2 5um", reversal), "EYX=harmonic 3 4um",
                    "EXY=harmonic 2 6um", "ECY=harmonic 2 20urad"});
      const auto made = compensated_piece(machine, errors, piece);
      ASSERT_TRUE(made) << to_string(made.error().front());
      EXPECT_LT(made->after.tip, allowed_residual(made->before)) << reversal;
      const PathError anew = run_independently(machine, errors, piece, made->piece).nominal;
      EXPECT_LT(anew.tip, allowed_residual(made->before)) << reversal;
    }
  }
}

}  // namespace
}  // namespace frustum::calibration

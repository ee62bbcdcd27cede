#include "kinematics/errors/volumetric.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include "kinematics/errors/error_ranking.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

GeometricErrors errors_from_texts(const Machine& machine, const std::vector<std::string>& texts) {
  std::vector<ErrorEntry> entries;
  for (const std::string& text : texts) entries.push_back(*parse_error(text));
  return *resolve(machine, entries);
}

TEST(Volumetric, IsZeroWithoutErrors) {
  for (const char* name : {"iwf-bc", "three-axis", "double-pivot-head"}) {
    const auto volume = volumetric_errors(shipped(name), {}, {.grid = 3, .tool_length = 100.0});
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->points.size(), 27U);
    EXPECT_LT(volume->relative.max, 1e-12) << name;
  }
}

TEST(Volumetric, SquarenessOfAThreeAxisMachineIsItsLever) {
  // EB0Z tilts the line of Z: the tip leaves by 20 urad times Z, in X, on the tool side alone.
  const Machine machine = shipped("three-axis");
  const auto volume =
      volumetric_errors(machine, errors_from_texts(machine, {"EB0Z=20urad"}), {.grid = 8});
  ASSERT_TRUE(volume);
  EXPECT_NEAR(volume->tool.max, 600.0 * 20e-6, 1e-9);  // Z goes to 600 mm
  EXPECT_EQ(volume->workpiece.max, 0.0);
  EXPECT_NEAR(volume->relative.p95, volume->relative.max, 1e-12);  // an eighth of the points has it
  EXPECT_NEAR(volume->worst().relative.x(), 600.0 * 20e-6, 1e-9);
  EXPECT_EQ(volume->worst().axes[Z], 600.0);
}

TEST(Volumetric, RelativeIsAsLongAsWhatTheWorkpieceSees) {
  const Machine machine = shipped("iwf-bc");
  const auto errors =
      errors_from_texts(machine, {"EB0C=30urad", "EX0C=5um", "EXX=linear 10um", "EAZ=12urad",
                                  "ECC=harmonic 1 20urad", "EYB=4um"});
  const VolumetricOptions options{
      .grid = 3, .tool_length = 120.0, .positions = {{}, {{B, 0.5}, {C, -2.0}}, {{C, 7.0}}}};
  const auto volume = volumetric_errors(machine, errors, options);
  ASSERT_TRUE(volume);
  ASSERT_EQ(volume->points.size(), 81U);
  EXPECT_EQ(volume->at_position(1).front().axes[B], 0.5);
  for (const VolumetricPoint& p : volume->points) {
    const Vec3 seen = actual_pose(machine, errors, p.axes, 120.0).translation -
                      nominal_pose(machine, p.axes, 120.0).translation;
    EXPECT_NEAR(seen.norm(), p.relative.norm(), 1e-11);
  }
  EXPECT_LE(volume->relative.p95, volume->relative.max);
  EXPECT_LE(volume->relative.mean, volume->relative.p95);
}

TEST(Volumetric, RanksErrorsOverTheVolumeByTheirMeanSquare) {
  const Machine machine = shipped("three-axis");
  const auto volume = volumetric_errors(machine, {}, {.grid = 2});
  const std::vector<std::string> names = {"EXX", "EB0Z"};
  const auto errors = errors_named(machine, names);
  const GainMatrix gains = mean_gains(machine, *errors, *volume, 0.0);
  const auto ranking = rank_by_gain(*errors, gains);
  // Z is -100 or 600: the lever's root mean square is 430.1 mm.
  EXPECT_EQ(ranking.front().name, "EXX");
  EXPECT_NEAR(ranking.back().weight, std::sqrt((0.01 + 0.36) / 2.0), 1e-12);
}

TEST(Volumetric, SaysWhatCannotBeLookedAt) {
  const Machine machine = shipped("iwf-bc");
  const auto message = [&](const VolumetricOptions& options) {
    const auto volume = volumetric_errors(machine, {}, options);
    return volume ? std::string("accepted") : volume.error().front().message;
  };
  EXPECT_EQ(message({.grid = 1}), "a grid of 1 point an axis");
  EXPECT_EQ(message({.positions = {{{A, 0.1}}}}),
            "machine iwf-bc (t-(C)-Z-Y-b-X-B-C-w) has no axis A");
  EXPECT_EQ(message({.positions = {{{X, 1000.0}}}}),
            "X = 1000 is outside its travel -400 .. 400 mm");
  EXPECT_EQ(message({.positions = {{{X, 0.0}}, {}}}),
            "axis X is held in one position and not in another");
  EXPECT_EQ(message({.positions = {{{C, 100.0}}}}), "accepted");  // endless
}

}  // namespace
}  // namespace frustum::kinematics

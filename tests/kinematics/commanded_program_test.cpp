// What is commanded once serves every set of errors.
#include "kinematics/controller/commanded_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "kinematics/controller/controller_state.hpp"
#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

Setup one_tool_setup() {
  Setup s;
  s.work_offsets = {{1, Vec3(10, 20, 30)}};
  s.tools = {{1, {.length = 100.0, .flute_length = 20.0}}};
  return s;
}

// Under tool centre point control, turning B and C along a wave.
std::vector<parser::Motion> tilting_program() {
  std::vector<parser::Motion> motions;
  std::uint32_t line = 0;
  const auto add = [&](parser::Command command) {
    motions.push_back({{++line, 1}, std::move(command)});
  };
  add(parser::ToolChange{1});
  add(parser::CompensationChange{parser::LengthCompensation::tool_centre_point, false, 1});
  for (int i = 0; i < 30; ++i) {
    parser::AxisTarget end;
    end[X] = 2.0 * i;
    end[Y] = 5.0 * std::sin(0.3 * i);
    end[Z] = 60.0;
    end[B] = -0.4 - 0.01 * i;
    end[C] = 0.05 * i;
    if (i == 0) {
      add(parser::Traverse{end});
    } else {
      add(parser::LinearFeed{.end = end, .feed = {600.0, parser::FeedMode::per_minute}});
    }
  }
  return motions;
}

GeometricErrors backlash_and_squareness() {
  GeometricErrors errors;
  errors[C].location[3] = 3e-5;
  errors[Y].component[1] = ErrorFunction(std::vector<ErrorTerm>{ReversalTerm{0.004}});
  return errors;
}

void expect_same(const ToolPath& a, const ToolPath& b) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    ASSERT_EQ(a.poses[i].tip, b.poses[i].tip);
    ASSERT_EQ(a.poses[i].axis, b.poses[i].axis);
    ASSERT_EQ(a.times[i], b.times[i]);
    ASSERT_EQ(a.axes[i].q, b.axes[i].q);
  }
}

TEST(CommandedProgram, GivesEveryTravelThePathOfAProgramCommandedForIt) {
  const Machine machine = shipped("iwf-bc");
  const auto setup = one_tool_setup();
  const auto motions = tilting_program();
  const auto commanded = command(machine, setup, motions);
  ASSERT_TRUE(commanded) << to_string(commanded.error().front());
  for (const GeometricErrors& errors :
       {GeometricErrors{}, backlash_and_squareness(), GeometricErrors{}}) {
    const auto once = travel(machine, setup, *commanded, errors);
    const auto alone = execute(machine, errors, setup, motions);
    ASSERT_TRUE(alone);
    expect_same(once.path, alone->path);
    EXPECT_EQ(once.cycle_time, alone->cycle_time);
  }
}

TEST(CommandedProgram, TakesTheToolAsItIsFromTheSetupOfTheTravel) {
  const Machine machine = shipped("iwf-bc");
  auto setup = one_tool_setup();
  const auto commanded = command(machine, setup, tilting_program());
  ASSERT_TRUE(commanded);
  const auto nominal = travel(machine, setup, *commanded, {});
  setup.tools[1].length_error = 0.1;
  const auto longer = travel(machine, setup, *commanded, {});
  const ToolPose& a = nominal.path.poses.back();
  const ToolPose& b = longer.path.poses.back();
  EXPECT_LT((b.tip - (a.tip - 0.1 * a.axis)).norm(), 1e-9);
}

TEST(CommandedProgram, OutlivesTheMachineItWasCommandedFor) {
  std::optional<Machine> machine = shipped("iwf-bc");
  const auto setup = one_tool_setup();
  const auto commanded = *command(*machine, setup, tilting_program());
  const auto before = travel(*machine, setup, commanded, {});
  machine.reset();
  const Machine again = shipped("iwf-bc");
  expect_same(travel(again, setup, commanded, {}).path, before.path);
}

TEST(ControllerState, FollowsOffsetsPlanesAndLengths) {
  const Machine machine = shipped("iwf-bc");
  auto setup = one_tool_setup();
  setup.work_offsets[2] = Vec3(1, 2, 3);
  ControllerState state(machine, setup);
  EXPECT_EQ(state.origin(), Vec3(10, 20, 30));
  state.follow(parser::WorkOffsetChange{2});
  EXPECT_EQ(state.origin(), Vec3(1, 2, 3));
  EXPECT_EQ(state.table_from_words().translation, Vec3(1, 2, 3));
  state.follow(parser::TiltedPlaneChange{Pose::translated(Vec3(0, 0, 5))});
  EXPECT_EQ(state.table_from_words().translation, Vec3(1, 2, 8));
  EXPECT_EQ(state.origin(), Vec3(1, 2, 3));
  state.follow(parser::CompensationChange{parser::LengthCompensation::tool_centre_point, false, 1});
  EXPECT_EQ(state.tool_length(), 100.0);
  EXPECT_EQ(state.tip_frame()->tool_length, 100.0);
  EXPECT_TRUE(state.modes().tip_control());
  // A word is an axis position at rotary zero: the shift takes the tip there.
  AxisPositions at_zero = with_linear_positions({}, state.axis_shift());
  EXPECT_LT((state.tip_at(at_zero) - state.origin()).norm(), 1e-9);
}

TEST(ControllerState, KnowsWhatTheSetupLacks) {
  const Machine machine = shipped("iwf-bc");
  const auto setup = one_tool_setup();
  ControllerState state(machine, setup);
  EXPECT_EQ(state.origin_of(3), nullptr);
  EXPECT_FALSE(state.length_of({parser::LengthCompensation::length, false, 7}));
  EXPECT_EQ(state.length_of({parser::LengthCompensation::length, false, 7, 42.0}), 42.0);
  // One axis alone places nothing that nobody knows.
  const parser::WorkOffsetSetting open{3, {5.0, std::nullopt, std::nullopt}};
  EXPECT_FALSE(state.placed(open));
  state.follow(open);
  EXPECT_EQ(state.origin_of(3), nullptr);
  state.follow(parser::WorkOffsetSetting{3, {5.0, 6.0, 7.0}});
  EXPECT_NE(state.origin_of(3), nullptr);
}

}  // namespace
}  // namespace frustum::kinematics

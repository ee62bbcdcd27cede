// A program and what the post-processor makes of it move the tool alike: by independent execution.
#include "post/planning/machine_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/parser/writing/read_back.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Execution;
using kinematics::Machine;
using kinematics::Setup;
using kinematics::shipped;
using kinematics::ToolPose;
using parser::Dialect;
using parser::first_of;
using parser::Motion;

constexpr double kLength = 150.0;

struct Case {
  Machine machine;
  Setup setup;
  std::vector<Motion> motions;
};

// Coarse chords: the sampling is fine enough already.
Case cone_on(const std::string& name, programs::ProgramForm form = programs::ProgramForm::vector) {
  programs::ConeFrustum cone;
  cone.form = form;
  cone.chord_tolerance = Mm{1e-1};
  const Machine machine = shipped(name);
  const auto piece = programs::cone_frustum(cone, machine);
  EXPECT_TRUE(piece);
  Setup setup;
  setup.work_offsets = piece->work_offsets;
  setup.tools[1] = {kLength, 0.0, 20.0};
  return {machine, setup, motions_in(piece->program, Dialect::fanuc)};
}

// A surface of waves, cut in lines with the tool leaning in all directions.
Case freeform_on(const std::string& name) {
  Case made{shipped(name), {}, {}};
  made.setup.work_offsets[1] = Vec3(-40.0, 20.0, 120.0);
  made.setup.tools[1] = {kLength, 0.0, 20.0};
  std::uint32_t line = 0;
  const auto add = [&](parser::Command command) {
    made.motions.push_back({{++line, 1}, std::move(command)});
  };
  add(parser::ToolChange{1});
  add(parser::SpindleChange{parser::SpindleDirection::clockwise, 8000.0});
  add(parser::CompensationChange{parser::LengthCompensation::tool_centre_point, true, 1});
  for (int pass = 0; pass < 4; ++pass) {
    for (int i = 0; i <= 40; ++i) {
      const double x = (pass % 2 == 0 ? 1 : -1) * (i - 20) * 2.0, y = 6.0 * pass - 9.0;
      const double z = 3.0 * std::sin(0.1 * x) * std::cos(0.15 * y);
      parser::AxisTarget end;
      end[AxisLetter::X] = x;
      end[AxisLetter::Y] = y;
      end[AxisLetter::Z] = z + (i == 0 ? 20.0 : 0.0);
      const double lean = 0.35 + 0.15 * std::sin(0.07 * x), around = 0.4 + 0.03 * x + 0.1 * y;
      const auto axis = UnitVec3::of(Vec3(std::sin(lean) * std::cos(around),
                                          std::sin(lean) * std::sin(around), std::cos(lean)));
      if (i == 0) {
        add(parser::Traverse{end, axis, parser::Coordinates::program});
      } else {
        add(parser::LinearFeed{
            end, axis, parser::Coordinates::program, {600.0, parser::FeedMode::per_minute}});
      }
    }
  }
  add(parser::Stop{});
  return made;
}

Execution executed(const Case& c, const std::vector<Motion>& motions, double bound = 1e-5) {
  kinematics::TravelOptions options;
  options.path_bound = bound;
  auto done = kinematics::execute(c.machine, {}, c.setup, motions, options);
  EXPECT_TRUE(done) << (done ? "" : first_of(done.error()));
  return done ? *std::move(done) : Execution{};
}

// Tool poses of the feed blocks, by line of the source.
std::map<std::uint32_t, std::vector<ToolPose>> by_line(const Execution& done) {
  std::map<std::uint32_t, std::vector<ToolPose>> lines;
  for (const auto& segment : done.path.segments) {
    const auto& block = done.path.blocks[segment.block];
    if (block.kind != kinematics::PathKind::feed) continue;
    auto& poses = lines[block.source_line];
    if (poses.empty()) poses.push_back(done.path.from(segment));
    poses.push_back(done.path.to(segment));
  }
  return lines;
}

struct Deviation {
  double tip = 0.0, axis = 0.0;
};

// Of a pose from a polyline, looked for near `around`, which then says where it was found.
Deviation deviation(const ToolPose& pose, const std::vector<ToolPose>& line, std::size_t window,
                    std::size_t& around) {
  Deviation least{1e9, 1e9};
  const std::size_t first = around > window ? around - window : 0;
  for (std::size_t i = first; i + 1 < std::min(line.size(), around + window + 2); ++i) {
    const Vec3 way = line[i + 1].tip - line[i].tip;
    const double t =
        way.squaredNorm() > 0.0
            ? std::clamp((pose.tip - line[i].tip).dot(way) / way.squaredNorm(), 0.0, 1.0)
            : 0.0;
    const ToolPose there = kinematics::between(line[i], line[i + 1], t);
    const double tip = (there.tip - pose.tip).norm();
    if (tip < least.tip) {
      least = {tip, angle_between(there.axis, pose.axis)};
      around = i;
    }
  }
  return least;
}

Deviation largest_deviation(const Execution& a, const Execution& b) {
  const auto lines = by_line(b);
  Deviation largest;
  std::size_t compared = 0;
  for (const auto& [line, poses] : by_line(a)) {
    const auto other = lines.find(line);
    if (other == lines.end()) {
      ADD_FAILURE() << "line " << line << " is missing";
      continue;
    }
    const std::size_t window = 8 + 4 * other->second.size() / poses.size();
    std::size_t around = 0;
    for (const ToolPose& pose : poses) {
      const Deviation here = deviation(pose, other->second, window, around);
      largest.tip = std::max(largest.tip, here.tip);
      largest.axis = std::max(largest.axis, here.axis);
      ++compared;
    }
  }
  EXPECT_GT(compared, 50U);
  return largest;
}

std::vector<Motion> planned(const Case& c, const PlanOptions& options) {
  auto plan = plan_for_machine(c.machine, c.setup, c.motions, options);
  EXPECT_TRUE(plan) << (plan ? "" : first_of(plan.error()));
  return plan ? std::move(plan->motions) : std::vector<Motion>{};
}

constexpr double kTolerance = 5e-3;

class PostLaws : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Families, PostLaws,
                         testing::Values("iwf-bc", "double-pivot-head", "swivel-head-table"));

TEST_P(PostLaws, EveryFormOfOutputKeepsToTheProgrammedPath) {
  for (const Case& c : {cone_on(GetParam()), cone_on(GetParam(), programs::ProgramForm::axes),
                        freeform_on(GetParam())}) {
    const Execution programmed = executed(c, c.motions);
    for (const OutputForm form : {OutputForm::axes, OutputForm::tip, OutputForm::vectors}) {
      const PlanOptions options{.output = form, .tolerance = Mm{kTolerance}};
      const Execution made = executed(c, planned(c, options));
      for (const Deviation& largest :
           {largest_deviation(made, programmed), largest_deviation(programmed, made)}) {
        EXPECT_LT(largest.tip, kTolerance + 1e-5);
        // A tip that is off along its path finds the axis that belongs a tolerance further on.
        EXPECT_LT(largest.axis, 1e-4);  // rad
      }
    }
  }
}

// Minutes of each line of the source, from the feed words alone.
std::map<std::uint32_t, double> minutes_by_line(const Case& c, const std::vector<Motion>& motions) {
  std::map<std::uint32_t, double> minutes;
  const Execution done = executed(c, motions);
  std::vector<double> lengths(done.path.blocks.size());
  for (const auto& s : done.path.segments) {
    lengths[s.block] += (done.path.to(s).tip - done.path.from(s).tip).norm();
  }
  std::size_t block = 0;
  for (const Motion& motion : motions) {
    const parser::Feed* feed = nullptr;
    if (const auto* linear = std::get_if<parser::LinearFeed>(&motion.command)) feed = &linear->feed;
    if (const auto* arc = std::get_if<parser::ArcFeed>(&motion.command)) feed = &arc->feed;
    if (feed == nullptr && !std::holds_alternative<parser::Traverse>(motion.command)) continue;
    // Blocks before the first tool are not in the path.
    while (block < done.path.blocks.size() &&
           done.path.blocks[block].source_line < motion.place.line) {
      ++block;
    }
    if (block == done.path.blocks.size() ||
        done.path.blocks[block].source_line != motion.place.line) {
      continue;
    }
    if (feed != nullptr) {
      minutes[motion.place.line] += feed->mode == parser::FeedMode::inverse_time
                                        ? 1.0 / feed->value
                                        : lengths[block] / feed->value;
    }
    ++block;
  }
  return minutes;
}

TEST_P(PostLaws, ABlockTakesTheTimeThatTheProgramGaveIt) {
  const Case c = freeform_on(GetParam());
  const auto programmed = minutes_by_line(c, c.motions);
  ASSERT_GT(programmed.size(), 100U);
  for (const OutputForm form : {OutputForm::axes, OutputForm::tip}) {
    const auto made = minutes_by_line(c, planned(c, {.output = form, .tolerance = Mm{kTolerance}}));
    for (const auto& [line, minutes] : programmed) {
      ASSERT_TRUE(made.contains(line)) << line;
      EXPECT_NEAR(made.at(line) / minutes, 1.0, 1e-6) << line;
    }
  }
}

std::vector<parser::Feed> feeds_of(const std::vector<Motion>& motions) {
  std::vector<parser::Feed> feeds;
  for (const Motion& motion : motions) {
    if (const auto* linear = std::get_if<parser::LinearFeed>(&motion.command)) {
      feeds.push_back(linear->feed);
    } else if (const auto* arc = std::get_if<parser::ArcFeed>(&motion.command)) {
      feeds.push_back(arc->feed);
    }
  }
  return feeds;
}

void expect_read_back(const Case& c, const std::vector<Motion>& motions, Dialect dialect) {
  const auto written = write_nc(motions, dialect);
  ASSERT_TRUE(written) << first_of(written.error());
  const Execution before = executed(c, motions, 1e-4);
  const auto read = motions_in(written->text, dialect);
  const Execution after = executed(c, read, 1e-4);
  ASSERT_EQ(before.axes.size(), after.axes.size());
  double tip = 0.0, axis = 0.0, feed = 0.0;
  for (std::size_t i = 0; i < before.axes.size(); ++i) {
    const Pose a = kinematics::nominal_pose(c.machine, before.axes[i].axes, kLength);
    const Pose b = kinematics::nominal_pose(c.machine, after.axes[i].axes, kLength);
    tip = std::max(tip, (a.translation - b.translation).norm());
    axis = std::max(axis, angle_between(a.rotation.col(2), b.rotation.col(2)));
    EXPECT_EQ(before.axes[i].kind, after.axes[i].kind);
  }
  const auto feeds = feeds_of(motions), feeds_read = feeds_of(read);
  ASSERT_EQ(feeds.size(), feeds_read.size());
  for (std::size_t i = 0; i < feeds.size(); ++i) {
    EXPECT_EQ(feeds[i].mode, feeds_read[i].mode);
    feed = std::max(feed, std::abs(feeds_read[i].value / feeds[i].value - 1.0));
  }
  EXPECT_NEAR(after.cycle_time / before.cycle_time, 1.0, 1e-6);
  EXPECT_LT(tip, 1e-5) << name_of(dialect);
  EXPECT_LT(axis, 1e-8) << name_of(dialect);
  EXPECT_LT(feed, 1e-6) << name_of(dialect);
}

TEST_P(PostLaws, WrittenTextReadBackAndExecutedGivesTheSameToolPath) {
  for (const Case& c : {cone_on(GetParam()), freeform_on(GetParam())}) {
    for (const OutputForm form : {OutputForm::axes, OutputForm::tip, OutputForm::vectors}) {
      const auto motions = planned(c, {.output = form, .tolerance = Mm{kTolerance}});
      for (const Dialect dialect : parser::written_dialects()) {
        if (form == OutputForm::vectors && dialect == Dialect::linuxcnc) continue;
        expect_read_back(c, motions, dialect);
      }
    }
  }
}

// --- single cases ------------------------------------------------------------------------------

Case fanuc_on(const std::string& name, const std::string& text) {
  Case made{shipped(name), {}, motions_in(text, Dialect::fanuc)};
  made.setup.work_offsets[1] = Vec3(-30.0, 10.0, 100.0);
  made.setup.tools[1] = {kLength, 0.0, 20.0};
  return made;
}

template <typename Command>
std::size_t count(const std::vector<Motion>& motions) {
  return static_cast<std::size_t>(
      std::count_if(motions.begin(), motions.end(),
                    [](const Motion& m) { return std::holds_alternative<Command>(m.command); }));
}

void expect_same_path(const Case& c, const PlanOptions& options, double axis = 1e-4) {
  const Execution programmed = executed(c, c.motions);
  const Execution made = executed(c, planned(c, options));
  for (const Deviation& largest :
       {largest_deviation(made, programmed), largest_deviation(programmed, made)}) {
    EXPECT_LT(largest.tip, options.tolerance.value + 1e-5);
    EXPECT_LT(largest.axis, axis);
  }
}

TEST(MachineProgram, RewindsWhereARotaryAxisRunsOutOfTravel) {
  // The head's C reaches 400 deg; the words go on to 1080.
  std::string text = "T1 M6\nS5000 M3\nG43.4 H1\nG0 X40. Y0. Z20. B30. C0.\nG1 Z0. F500\n";
  for (int turn = 20; turn <= 1080; turn += 20) {
    const double a = turn * kRadPerDeg;
    text += "X" + std::to_string(40.0 * std::cos(a)) + " Y" + std::to_string(40.0 * std::sin(a)) +
            " C" + std::to_string(turn) + ".\n";
  }
  const Case c = fanuc_on("double-pivot-head", text + "M30\n");
  for (const OutputForm form : {OutputForm::axes, OutputForm::tip}) {
    const auto plan = plan_for_machine(c.machine, c.setup, c.motions, {.output = form});
    ASSERT_TRUE(plan) << first_of(plan.error());
    EXPECT_GE(plan->rewinds, 1U);
    EXPECT_LE(plan->rewinds, 2U);
    // Every line ends where its words say, whatever the positions of the head.
    std::map<std::uint32_t, AxisPositions> ends;
    for (const auto& sample : executed(c, plan->motions).axes)
      ends[sample.source_line] = sample.axes;
    for (int turn = 20; turn <= 1080; turn += 20) {
      const auto line = static_cast<std::uint32_t>(5 + turn / 20);
      ASSERT_TRUE(ends.contains(line)) << line;
      const Pose pose = kinematics::nominal_pose(c.machine, ends[line], kLength);
      const double a = turn * kRadPerDeg;
      const Vec3 tip = Vec3(40.0 * std::cos(a), 40.0 * std::sin(a), 0.0);
      const Vec3 axis(0.5 * std::cos(a), 0.5 * std::sin(a), std::sqrt(0.75));
      EXPECT_LT((pose.translation - c.setup.work_offsets.at(1) - tip).norm(), 2e-6) << line;
      EXPECT_LT(angle_between(pose.rotation.col(2), axis), 1e-6) << line;
    }
  }
}

TEST(MachineProgram, KeepsArcsWhereTheMachineMayCutThem) {
  const std::string head = "T1 M6\nS5000 M3\nG43.4 H1\nG0 X40. Y0. Z20. ";
  const std::string arc = "\nG1 Z0. F500\nG2 X0. Y-40. I-40. J0.\nG3 X40. Y0. I0. J40. Z-3.\nM30\n";
  const Case upright = fanuc_on("iwf-bc", head + "B0. C30." + arc);
  const Case leaning = fanuc_on("iwf-bc", head + "B20. C30." + arc);
  for (const OutputForm form : {OutputForm::axes, OutputForm::tip}) {
    const PlanOptions keep{.output = form}, flat{.output = form, .arcs = ArcForm::flat},
        none{.output = form, .arcs = ArcForm::none};
    EXPECT_EQ(count<parser::ArcFeed>(planned(upright, keep)), 2U);
    EXPECT_EQ(count<parser::ArcFeed>(planned(upright, flat)), 1U);
    EXPECT_EQ(count<parser::ArcFeed>(planned(upright, none)), 0U);
    EXPECT_EQ(count<parser::ArcFeed>(planned(leaning, keep)), 0U);
    for (const PlanOptions& options : {keep, flat, none}) expect_same_path(upright, options);
    expect_same_path(leaning, keep);
  }
}

TEST(MachineProgram, ResolvesTiltedPlanes) {
  const Case c =
      fanuc_on("iwf-bc",
               "T1 M6\nS5000 M3\nG54\nG68.2 X5. Y3. Z2. I0. J0. K0.\nG53.1\nG43 H1\n"
               "G0 X0. Y0. Z30.\nG1 Z0. F400\nX20.\nY15.\nG0 Z30.\nG69\n"
               "G68.2 X5. Y3. Z2. I90. J25. K-90.\nG53.1\nG43 H1\nG0 X0. Y0. Z30.\n"
               "G1 Z0. F400\nX20.\nG2 X30. Y-10. I0. J-10.\nG1 Y15.\nG0 Z30.\nG69\nM30\n");
  for (const OutputForm form : {OutputForm::axes, OutputForm::tip}) {
    const PlanOptions options{.output = form};
    EXPECT_EQ(count<parser::TiltedPlaneChange>(planned(c, options)), 0U);
    expect_same_path(c, options);
  }
}

TEST(MachineProgram, FollowsGreatCirclesByShortBlocksOrLeavesThemToTheReader) {
  Case c = freeform_on("iwf-bc");
  c.motions.insert(c.motions.begin(),
                   {{1, 1}, parser::OrientationPathChange{parser::OrientationPath::great_circle}});
  expect_same_path(c, {.output = OutputForm::axes, .tolerance = Mm{kTolerance}});
  const PlanOptions blocks{.tolerance = Mm{kTolerance}};
  const PlanOptions reader{.great_circle = true, .tolerance = Mm{kTolerance}};
  expect_same_path(c, blocks);
  expect_same_path(c, reader);
  EXPECT_GT(planned(c, blocks).size(), 2 * planned(c, reader).size());
}

// A thousandth of a degree beside the pole the tool axis goes round by 90 degrees: so does C.
TEST(MachineProgram, Fault2_33_ThePoleToleranceLetsTheTurningAxisRest) {
  const Case c = fanuc_on("iwf-bc",
                          "T1 M6\nS5000 M3\nG43.5 H1\nG0 X0. Y0. Z20. I0. J0. K1.\n"
                          "G1 X1. I0.0000174533 J0. K1. F500\nX2. I0. J0.0000174533 K1.\n"
                          "X3. I0.1 J0. K1.\n");
  const auto turned = [&](Rad tolerance) {
    double from = 0.0, to = 0.0;
    for (const Motion& motion : planned(c, {.pole_tolerance = tolerance})) {
      const auto* feed = std::get_if<parser::LinearFeed>(&motion.command);
      if (feed == nullptr || !feed->end[AxisLetter::C]) continue;
      from = std::min(from, *feed->end[AxisLetter::C]);
      to = std::max(to, *feed->end[AxisLetter::C]);
    }
    return to - from;
  };
  EXPECT_NEAR(turned(Rad{1e-7}), 90.0 * kRadPerDeg, 1e-3);
  EXPECT_NEAR(turned(Rad{2e-5}), 0.0, 1e-9);
}

TEST(MachineProgram, StartsAndEndsWithTheToolRetracted) {
  const Case c =
      fanuc_on("iwf-bc", "T1 M6\nS5000 M3\nM8\nG43.4 H1\nG0 X0. Y0. Z20. B10. C0.\nG1 Z0. F500\n");
  const auto motions = planned(c, {});
  const auto* first = std::get_if<parser::Traverse>(&motions.front().command);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->coordinates, parser::Coordinates::machine);
  EXPECT_EQ(first->end[AxisLetter::Z], c.machine.home()[AxisLetter::Z]);
  ASSERT_GE(motions.size(), 5U);
  const std::size_t n = motions.size();
  EXPECT_TRUE(std::holds_alternative<parser::Stop>(motions[n - 1].command));
  EXPECT_TRUE(std::holds_alternative<parser::CoolantChange>(motions[n - 2].command));
  EXPECT_TRUE(std::holds_alternative<parser::SpindleChange>(motions[n - 3].command));
  EXPECT_TRUE(std::holds_alternative<parser::Traverse>(motions[n - 4].command));
  EXPECT_TRUE(std::holds_alternative<parser::CompensationChange>(motions[n - 5].command));
}

TEST(MachineProgram, NeedsTheToolLengthForAxisPositionsOnly) {
  Case c = fanuc_on("iwf-bc", "T1 M6\nG43.4 H1\nG0 X0. Y0. Z20. B10. C0.\nG1 Z0. F500\nM30\n");
  c.setup.tools.clear();
  const auto axes = plan_for_machine(c.machine, c.setup, c.motions, {.output = OutputForm::axes});
  ASSERT_FALSE(axes);
  EXPECT_EQ(axes.error().front().message, "axis positions need the length of tool 1");
  EXPECT_EQ(axes.error().front().line, 3);
  EXPECT_NE(axes.error().front().hint.find("--tool-length 1=LENGTH"), std::string::npos);
  const auto tip = plan_for_machine(c.machine, c.setup, c.motions, {});
  ASSERT_TRUE(tip) << first_of(tip.error());
  EXPECT_EQ(tip->warnings.size(), 1U);
}

// Z350 less the length of 150 is where Z50 is with it.
TEST(MachineProgram, AddsTheLengthThatG44TakesAway) {
  const std::string text = "T1 M6\nS500 M3\nG44 H1\nG0 X0. Y0. Z350.\nG1 X10. Z340. F500\nM30\n";
  Case c = fanuc_on("three-axis", text);
  const auto motions = planned(c, {.output = OutputForm::axes});
  std::vector<double> heights;
  for (const Motion& motion : motions) {
    const auto* change = std::get_if<parser::CompensationChange>(&motion.command);
    EXPECT_TRUE(change == nullptr || !change->negative);
    const auto* move = std::get_if<parser::LinearFeed>(&motion.command);
    if (move != nullptr) heights.push_back(move->end[AxisLetter::Z].value_or(-1.0));
  }
  ASSERT_EQ(heights.size(), 1U);
  EXPECT_NEAR(heights[0], 40.0, 1e-9);
  const auto cut_end = [&](const std::vector<Motion>& program) {
    double z = std::nan("");
    for (const auto& sample : executed(c, program).axes) {
      if (sample.source_line == 5) z = sample.axes[AxisLetter::Z];
    }
    return z;
  };
  EXPECT_NEAR(cut_end(motions), cut_end(c.motions), 1e-9);
  c.setup.tools.clear();
  const auto unknown =
      plan_for_machine(c.machine, c.setup, c.motions, {.output = OutputForm::axes});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().message, "axis positions need the length of tool 1");
}

TEST(MachineProgram, RefusesWhatTheMachineCannotDo) {
  const auto message = [](const std::string& machine, const std::string& text) {
    const Case c = fanuc_on(machine, text);
    const auto plan = plan_for_machine(c.machine, c.setup, c.motions, {});
    return plan ? std::string("none") : first_of(plan.error());
  };
  EXPECT_NE(message("iwf-bc", "T1 M6\nG43.4 H1\nG0 X0. Y0. Z0. A10.\n").find("has no axis A"),
            std::string::npos);
  EXPECT_NE(message("three-axis", "T1 M6\nG43.5 H1\nG0 X0. Y0. Z0. I1. J0. K1.\n").find(":3:"),
            std::string::npos);
  EXPECT_NE(message("iwf-bc", "T1 M6\nG43.4 H1\nG0 X0. Y0. Z900. B0.\n").find("over-travel: Z"),
            std::string::npos);
  EXPECT_NE(message("iwf-bc", "T1 M6\nG55 G43.4 H1\nG0 X0. Y0. Z0. B0.\n").find("G55"),
            std::string::npos);
}

}  // namespace
}  // namespace frustum::post

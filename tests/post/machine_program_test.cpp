// A program and what the post-processor makes of it move the tool alike: by independent execution.
#include "post/machine_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/chain.hpp"
#include "programs/cone_frustum.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/post/read_back.hpp"

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
  cone.chord_tolerance = Mm{3e-2};
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
  kinematics::ControllerOptions options;
  options.path_bound = bound;
  auto done = kinematics::execute(c.machine, {}, c.setup, motions, options);
  EXPECT_TRUE(done) << (done ? "" : first_of(done.error()));
  return done ? *std::move(done) : Execution{};
}

// Tool poses of the feed blocks, by line of the source.
std::map<std::uint32_t, std::vector<ToolPose>> by_line(const Execution& done) {
  std::map<std::uint32_t, std::vector<ToolPose>> lines;
  for (const auto& stretch : done.path.stretches) {
    const auto& block = done.path.blocks[stretch.block];
    if (block.kind != kinematics::PathKind::feed) continue;
    auto& poses = lines[block.source_line];
    if (poses.empty()) poses.push_back(done.path.from(stretch));
    poses.push_back(done.path.to(stretch));
  }
  return lines;
}

struct Deviation {
  double tip = 0.0, axis = 0.0;
};

// Of a pose from a polyline of poses.
Deviation deviation(const ToolPose& pose, const std::vector<ToolPose>& line) {
  Deviation least{1e9, 1e9};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 way = line[i + 1].tip - line[i].tip;
    const double t =
        way.squaredNorm() > 0.0
            ? std::clamp((pose.tip - line[i].tip).dot(way) / way.squaredNorm(), 0.0, 1.0)
            : 0.0;
    const ToolPose there = kinematics::between(line[i], line[i + 1], t);
    const double tip = (there.tip - pose.tip).norm();
    if (tip < least.tip) least = {tip, angle_between(there.axis, pose.axis)};
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
    for (const ToolPose& pose : poses) {
      const Deviation here = deviation(pose, other->second);
      largest.tip = std::max(largest.tip, here.tip);
      largest.axis = std::max(largest.axis, here.axis);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100U);
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
  for (const auto& s : done.path.stretches) {
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

void expect_read_back(const Case& c, const std::vector<Motion>& motions, Dialect dialect) {
  const auto written = write_nc(motions, dialect);
  ASSERT_TRUE(written) << first_of(written.error());
  const Execution before = executed(c, motions, 1e-4);
  const Execution after = executed(c, motions_in(written->text, dialect), 1e-4);
  ASSERT_EQ(before.axes.size(), after.axes.size());
  double tip = 0.0, axis = 0.0, feed = 0.0;
  for (std::size_t i = 0; i < before.axes.size(); ++i) {
    const Pose a = kinematics::nominal_pose(c.machine, before.axes[i].axes, kLength);
    const Pose b = kinematics::nominal_pose(c.machine, after.axes[i].axes, kLength);
    tip = std::max(tip, (a.translation - b.translation).norm());
    axis = std::max(axis, angle_between(a.rotation.col(2), b.rotation.col(2)));
    EXPECT_EQ(before.axes[i].kind, after.axes[i].kind);
  }
  ASSERT_EQ(before.path.blocks.size(), after.path.blocks.size());
  for (std::size_t i = 0; i < before.path.blocks.size(); ++i) {
    const double f = before.path.blocks[i].feed;
    if (f > 0.0) feed = std::max(feed, std::abs(after.path.blocks[i].feed / f - 1.0));
  }
  EXPECT_LT(tip, 1e-5) << name_of(dialect);
  EXPECT_LT(axis, 1e-8) << name_of(dialect);
  EXPECT_LT(feed, 1e-6) << name_of(dialect);
}

TEST_P(PostLaws, WrittenTextReadBackAndExecutedGivesTheSameToolPath) {
  for (const Case& c : {cone_on(GetParam()), freeform_on(GetParam())}) {
    for (const OutputForm form : {OutputForm::axes, OutputForm::tip, OutputForm::vectors}) {
      const auto motions = planned(c, {.output = form, .tolerance = Mm{kTolerance}});
      for (const Dialect dialect : written_dialects()) {
        if (form == OutputForm::vectors && dialect == Dialect::linuxcnc) continue;
        expect_read_back(c, motions, dialect);
      }
    }
  }
}

}  // namespace
}  // namespace frustum::post

// Step pattern pieces cut and looked at: which step made which surface, no collisions, 3+2 motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "core/ray.hpp"
#include "kinematics/controller/controller.hpp"
#include "metrology/plan/strategy.hpp"
#include "parser/interpreter.hpp"
#include "programs/step/step_pattern.hpp"
#include "trials/trial.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;

kinematics::Machine pattern_machine(const std::string& name) {
  auto loaded =
      kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  EXPECT_TRUE(loaded);
  return *loaded;
}

StepTest test_of(int workpiece, std::vector<std::string> patterns = {}) {
  StepTest test;
  test.workpiece = *step_workpiece(workpiece);
  test.patterns = std::move(patterns);
  return test;
}

StepPiece made(const StepTest& test, const kinematics::Machine& on) {
  auto piece = step_pattern(test, on);
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  return piece ? *piece : StepPiece{};
}

std::string refusals(const StepTest& test, const kinematics::Machine& on) {
  const auto piece = step_pattern(test, on);
  EXPECT_FALSE(piece);
  std::string text;
  if (!piece) {
    for (const Diagnostic& d : piece.error()) text += to_string(d) + "\n";
  }
  return text;
}

// "1-a c" cuts the features "1-a.S_c" and "1-a.B_c".
std::string operation_of(const std::string& feature) {
  const auto dot = feature.find('.');
  return feature.substr(0, dot) + " " + feature.back();
}

struct Setting {
  const char* machine;
  int workpiece;
  std::vector<std::string> patterns;
};

std::vector<Setting> settings() {
  return {{"zx-yac", 1, {}}, {"zx-yac", 2, {}},  {"zx-yac", 2, {"4", "6-a"}}, {"iwf-bc", 1, {}},
          {"iwf-bc", 2, {}}, {"dvf5000", 1, {}}, {"dvf5000", 2, {}},          {"zx-yac", 2, {"7"}}};
}

TEST(StepPatternSystem, EveryMeasuredPointIsCutByItsOwnStepAndNothingCollides) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(std::string(s.machine) + " workpiece " + std::to_string(s.workpiece));
    const auto on = pattern_machine(s.machine);
    const StepPiece step = made(test_of(s.workpiece, s.patterns), on);
    trials::TrialOptions options;
    options.measure = false;
    const auto trial =
        trials::run_trial(on, kinematics::GeometricErrors{}, step.piece, {}, options);
    ASSERT_TRUE(trial) << to_string(trial.error().front());
    EXPECT_TRUE(trial->collisions.empty()) << "line " << trial->collisions.front().source_line
                                           << ", " << trial->collisions.front().depth << " mm";
    std::map<std::string, Operation> operations;
    for (const Operation& op : step.piece.operations) operations[op.name] = op;
    std::size_t points = 0;
    for (const metrology::PlannedFeature& feature : step.piece.plan.features) {
      const Operation& op = operations.at(operation_of(feature.name));
      for (const auto& planned : metrology::planned_points(feature)) {
        // From where the ball's surface starts its approach to as far as it searches.
        const double start = step.piece.plan.probe.clearance;
        const Ray ray{planned.point + start * planned.normal, -planned.normal};
        const auto met =
            trial->workpiece->first_surface(ray, {0.0, start + step.piece.plan.probe.reach});
        ASSERT_TRUE(met) << feature.name << " at " << planned.point.transpose();
        EXPECT_NEAR(met->s, start, 2e-6) << feature.name << " at " << planned.point.transpose();
        EXPECT_TRUE(met->source_line >= op.first_line && met->source_line <= op.last_line)
            << feature.name << " at " << planned.point.transpose() << " is cut by line "
            << met->source_line << ", not " << op.first_line << " .. " << op.last_line;
        EXPECT_GT(met->normal.dot(planned.normal), 1.0 - 1e-9) << feature.name;
        ++points;
      }
    }
    EXPECT_GT(points, 60U);
  }
}

TEST(StepPatternSystem, MeasuresZeroOnAnErrorFreeMachine) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(std::string(s.machine) + " workpiece " + std::to_string(s.workpiece));
    const auto on = pattern_machine(s.machine);
    const StepPiece step = made(test_of(s.workpiece, s.patterns), on);
    const auto trial = trials::run_trial(on, kinematics::GeometricErrors{}, step.piece, {});
    ASSERT_TRUE(trial) << to_string(trial.error().front());
    const auto& found = trial->measurement.characteristics;
    ASSERT_EQ(found.size(), step.piece.plan.characteristics.size());
    double worst = 0.0;
    for (const auto& c : found) {
      EXPECT_NEAR(c.value, 0.0, 0.01) << c.name << " " << c.unit;
      worst = std::max(worst, std::abs(c.value));
    }
    std::printf("%s workpiece %d: %zu characteristics, worst %.2g um or urad\n", s.machine,
                s.workpiece, found.size(), worst);
  }
}

// The ball meets nothing but the surface it is sent to: all that it sweeps on the way is free.
TEST(StepPatternSystem, TheProbeReachesEveryPoint) {
  for (const int number : {1, 2}) {
    const auto on = pattern_machine("zx-yac");
    const StepPiece step = made(test_of(number), on);
    trials::TrialOptions options;
    options.measure = false;
    options.find_collisions = false;
    const auto trial =
        trials::run_trial(on, kinematics::GeometricErrors{}, step.piece, {}, options);
    ASSERT_TRUE(trial);
    const auto& probe = step.piece.plan.probe;
    const double r = 0.5 * probe.ball_diameter;
    for (const metrology::PlannedFeature& feature : step.piece.plan.features) {
      for (const auto& planned : metrology::planned_points(feature)) {
        const Vec3 n = planned.normal;
        const Vec3 u = perpendicular_to(n), v = n.cross(u);
        for (int i = 0; i < 12; ++i) {
          const double angle = 30.0 * kRadPerDeg * i;
          const Vec3 beside = r * (std::cos(angle) * u + std::sin(angle) * v);
          const Ray ray{planned.point + beside + (2.0 * r + probe.clearance) * n, -n};
          const auto met = trial->workpiece->material_along(ray, {0.0, r + probe.clearance});
          EXPECT_TRUE(met.empty()) << feature.name << " at " << planned.point.transpose();
        }
      }
    }
  }
}

TEST(StepPattern, NoBlockTurnsTheTableWhileItCuts) {
  const auto on = pattern_machine("zx-yac");
  for (const int number : {1, 2}) {
    const StepPiece step = made(test_of(number), on);
    const auto program = parser::parse_program(step.piece.program, "step.nc");
    ASSERT_TRUE(program) << to_string(program.error().front());
    const auto motions = parser::motions_of(*program);
    ASSERT_TRUE(motions) << to_string(motions.error().front());
    kinematics::Setup setup;
    setup.work_offsets = step.piece.work_offsets;
    setup.tools[1] = {.length = 150.0};
    const auto run = kinematics::command(on, setup, *motions);
    ASSERT_TRUE(run) << to_string(run.error().front());
    kinematics::AxisPositions before = on.home();
    std::size_t feeds = 0;
    for (const kinematics::AxisSample& sample : kinematics::block_ends(*run)) {
      bool rotary = false, linear = false;
      for (const AxisLetter letter : kinematics::kAxisLetters) {
        if (std::abs(sample.axes[letter] - before[letter]) < 1e-12) continue;
        (kinematics::is_rotary(letter) ? rotary : linear) = true;
      }
      EXPECT_FALSE(rotary && (linear || sample.kind == kinematics::PathKind::feed))
          << "line " << sample.source_line;
      feeds += sample.kind == kinematics::PathKind::feed ? 1 : 0;
      before = sample.axes;
    }
    EXPECT_EQ(feeds, 3 * step.cuts.size());
  }
}

TEST(StepPattern, RefusesWhatCannotBeAndSaysWhatToDo) {
  const auto on = pattern_machine("zx-yac");
  const auto expect = [](const std::string& text, std::vector<std::string> words) {
    for (const std::string& word : words) {
      EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' in: " << text;
    }
  };
  expect(refusals(test_of(2, {"3", "4"}), on), {"patterns 3 and 4 cut the same surfaces"});
  expect(refusals(test_of(1, {"1-c"}), on), {"there is no pattern '1-c'", "1-a"});
  expect(refusals(test_of(1, {"7"}), on), {"workpiece 1 does not carry pattern 7", "1-a, 1-b"});
  StepTest thick = test_of(2);
  thick.tool_diameter = {30.0};
  expect(refusals(thick, on), {"tool-diameter", "30 mm", "21"});
  expect(refusals(test_of(1), pattern_machine("three-axis")), {"three-axis", "rotary axes"});
}

TEST(StepPattern, NamesEveryPatternOutOfReachAndHowMuchIsShort) {
  // iwf-bc with its tilt cut down to +-40 deg.
  const std::string file = testing::TempDir() + "narrow.toml";
  {
    std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto at = text.find("[-110, 110]");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 11, "[-40, 60]");
    std::ofstream(file) << text;
  }
  const auto narrow = kinematics::Machine::load(file);
  ASSERT_TRUE(narrow);
  const std::string text = refusals(test_of(2), *narrow);
  for (const char* words :
       {"pattern 3: B = -90 deg, travel -40 .. 60 deg: 50 deg short",
        "pattern 5-a: B = -45 deg, travel -40 .. 60 deg: 5 deg short", "pattern 5-b: B = -45",
        "pattern 6-a: B = -45", "pattern 6-b: B = -45", "pattern 7: B = -45"}) {
    EXPECT_NE(text.find(words), std::string::npos) << "'" << words << "' in:\n" << text;
  }
  EXPECT_EQ(text.find("reference"), std::string::npos) << text;
  EXPECT_TRUE(step_pattern(test_of(1), *narrow));
  // Out of linear travel: the axis, and by how much.
  StepTest far = test_of(1, {"1-a"});
  far.workpiece.centre_x = 500.0;
  EXPECT_NE(refusals(far, pattern_machine("zx-yac")).find("pattern 1-a: X = "), std::string::npos);
}

TEST(StepPattern, ReferencesComeFirstAndAreSharedOnWorkpiece2) {
  const auto on = pattern_machine("zx-yac");
  std::vector<std::string> names;
  for (const StepCut& cut : made(test_of(2), on).cuts) names.push_back(cut.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"ref a", "ref b", "3 c", "3 d", "5-a c", "5-a d", "5-b c",
                                      "5-b d", "6-a c", "6-a d", "6-b c", "6-b d", "7 c", "7 d"}));
  EXPECT_EQ(made(test_of(1), on).cuts.size(), 16U);
  EXPECT_EQ(made(test_of(1), on).cuts.front().name, "1-a a");
}

}  // namespace
}  // namespace frustum::programs

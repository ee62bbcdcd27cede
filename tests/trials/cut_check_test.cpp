#include "trials/cut_check.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "tests/trials/step_trial.hpp"
#include "tests/trials/surface_at_point.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

using testing::HasSubstr;
using testing::Not;

// Pattern 3 on workpiece 2, cut from a blank with that allowance by a machine with that error.
struct Cut {
  programs::TestPiece piece{};
  Trial trial{};

  static Cut with(double allowance, const std::vector<std::string>& errors,
                  const std::function<void(programs::TestPiece&)>& change = {}) {
    programs::StepTest test;
    test.workpiece = *programs::step_workpiece(2);
    test.patterns = {"3"};
    test.allowance = Mm{allowance};
    auto made = programs::step_pattern(test, step_machine());
    EXPECT_TRUE(made) << (made ? "" : to_string(made.error().front()));
    Cut cut{.piece = made->piece};
    if (change) change(cut.piece);
    std::vector<kinematics::ErrorEntry> entries;
    entries.reserve(errors.size());
    for (const std::string& text : errors) entries.push_back(*kinematics::parse_error(text));
    auto trial = run_trial(step_machine(), entries, cut.piece, {}, {.find_collisions = false});
    EXPECT_TRUE(trial) << (trial ? "" : to_string(trial.error().front()));
    cut.trial = *trial;
    return cut;
  }

  [[nodiscard]] std::size_t points_of(const std::string& feature) const {
    for (const auto& f : trial.measurement.features) {
      if (f.name == feature) return f.points.size();
    }
    return 0;
  }
  // The one finding about a feature; empty when there is none.
  [[nodiscard]] std::string finding(const std::string& feature) const {
    std::string text;
    for (const Diagnostic& d : trial.wrong_cuts) {
      if (!d.message.starts_with("feature '" + feature + "'")) continue;
      EXPECT_TRUE(text.empty()) << feature << " is reported twice";
      EXPECT_EQ(d.severity, Severity::warning);
      EXPECT_FALSE(d.hint.empty());
      text = d.message;
    }
    return text;
  }
};

programs::Operation& operation(programs::TestPiece& piece, const std::string& name) {
  return *std::find_if(piece.operations.begin(), piece.operations.end(),
                       [&](const programs::Operation& op) { return op.name == name; });
}

TEST(CutCheck, FindsNothingOnAPartThatEveryStepCut) {
  for (const std::vector<std::string>& errors :
       {std::vector<std::string>{}, {"dz_AY=30um", "alpha_ZY=40urad"}}) {
    const Cut cut = Cut::with(0.5, errors);
    for (const Diagnostic& d : cut.trial.wrong_cuts) ADD_FAILURE() << to_string(d);
    std::size_t made = 0;
    for (const programs::Operation& op : cut.piece.operations) made += op.makes.size();
    EXPECT_EQ(made, 8U);  // S and B of a, b, c and d were looked at
  }
}

TEST(CutCheck, CountsThePointsOfAFeatureThatLieOnTheUncutBlank) {
  // The table stands 60 um low, the blank is 20 um larger than the part: level cuts do not reach
  // it.
  const Cut cut = Cut::with(0.02, {"dz_AY=-60um"});
  const std::size_t points = cut.points_of("ref.B_a");
  ASSERT_GT(points, 20U);
  EXPECT_EQ(cut.finding("ref.B_a"),
            "feature 'ref.B_a': " + std::to_string(points) + " of " + std::to_string(points) +
                " measured points are on the uncut blank, not on what operation 'ref a' cuts");
  EXPECT_THAT(cut.finding("ref.B_b"), HasSubstr("uncut blank"));
  // The sides of the reference steps are upright: a low table does not matter to them.
  EXPECT_EQ(cut.finding("ref.S_a"), "");
  EXPECT_EQ(cut.finding("ref.S_b"), "");
}

TEST(CutCheck, TellsAFeatureThatAnotherOperationCut) {
  // The job says that step c makes the bottom of reference step a as well.
  const Cut cut = Cut::with(0.5, {}, [](programs::TestPiece& piece) {
    operation(piece, "3 c").makes.emplace_back("ref.B_a");
  });
  const std::string points = std::to_string(cut.points_of("ref.B_a"));
  EXPECT_EQ(cut.finding("ref.B_a"), "feature 'ref.B_a': " + points + " of " + points +
                                        " measured points were cut by another operation than "
                                        "'3 c'");
  EXPECT_EQ(cut.trial.wrong_cuts.size(), 1U);
}

TEST(CutCheck, PassesOverFeaturesThatWereNotMeasured) {
  const Cut cut = Cut::with(0.5, {}, [](programs::TestPiece& piece) {
    operation(piece, "3 c").makes.emplace_back("no.such_feature");
  });
  EXPECT_TRUE(cut.trial.wrong_cuts.empty());
}

TEST(CutCheck, FindsTheSurfaceAtAPointOnlyWithinItsReach) {
  const Cut cut = Cut::with(0.5, {});
  const Vec3 up = Vec3::UnitZ();
  const auto& feature = cut.trial.measurement.features;
  const auto bottom = std::find_if(feature.begin(), feature.end(),
                                   [](const auto& f) { return f.name == "ref.B_a"; });
  ASSERT_NE(bottom, feature.end());
  const Vec3 on = cut.trial.measurement.workpiece_from_datum.point(bottom->points.front().point);
  EXPECT_TRUE(surface_at_point(*cut.trial.workpiece, on, up));
  EXPECT_TRUE(surface_at_point(*cut.trial.workpiece, on + 0.9 * kSurfaceSearch * up, up));
  EXPECT_FALSE(surface_at_point(*cut.trial.workpiece, on + 1.1 * kSurfaceSearch * up, up));
}

TEST(CutCheck, KnowsWhatCutEveryTouchedPointAsTheWorkpieceSaysWhenItIsAskedAgain) {
  const Cut cut = Cut::with(0.02, {"dz_AY=-60um"});
  const stock::Workpiece& workpiece = *cut.trial.workpiece;
  std::size_t points = 0, uncut = 0;
  for (const auto& feature : cut.trial.measurement.features) {
    ASSERT_EQ(feature.touches.size(), feature.points.size()) << feature.name;
    for (const metrology::Touch& touch : feature.touches) {
      const auto again = surface_at_point(workpiece, touch.point, touch.normal);
      ASSERT_TRUE(again);
      ASSERT_TRUE(touch.provenance);
      EXPECT_LT((again->point - touch.point).norm(), 1e-9);
      EXPECT_EQ(touch.provenance->segment.has_value(), again->segment.has_value());
      EXPECT_EQ(touch.provenance->source_line, again->source_line);
      EXPECT_NEAR(touch.provenance->bound, again->bound, 1e-12);
      EXPECT_GT(touch.provenance->bound, touch.provenance->sweep_bound - 1e-15);
      ++points;
      uncut += again->segment ? 0 : 1;
    }
  }
  EXPECT_GT(points, 100U);
  EXPECT_GT(uncut, 20U);
}

TEST(CutCheck, NeedsNoProvenanceOfPointsFromElsewhere) {
  Cut cut = Cut::with(0.02, {"dz_AY=-60um"});
  for (auto& feature : cut.trial.measurement.features) feature.touches.clear();
  EXPECT_TRUE(
      wrongly_cut_features(cut.piece, cut.trial.workpiece->removed().path(), cut.trial.measurement)
          .empty());
}

}  // namespace
}  // namespace frustum::trials

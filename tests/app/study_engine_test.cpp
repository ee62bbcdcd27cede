// The linear engine through an NC program, its cut and its probes: whether its bound holds, and
// what it refuses. A cone in chords of 5 nm, measured alone, so that points are followed from one
// machine to the next.
#include "app/study/engine_choice.hpp"

#include <gmock/gmock.h>

#include "programs/cone/cone_frustum.hpp"
#include "tests/app/cone_alone.hpp"
#include "tests/law_count.hpp"

namespace frustum::app {
namespace {

using studies::EngineKind;
using testing::HasSubstr;

// Table 3.9 on the cone of this set-up; errors of some patterns scaled.
StudyFile fine_cone(const char* setup, char read, std::vector<studies::ScaleRule> more) {
  auto study = *cone_study(setup, read);
  programs::ConeFrustum cone;
  if (std::string(setup) == "comparison") cone.center = Vec3(48.9, 0.0, 66.1);
  auto piece = programs::cone_frustum(cone, study.machine());
  EXPECT_TRUE(piece);
  piece->reading = study.job->piece.reading;
  study.job->piece = *std::move(piece);
  measure_the_cone_alone(study);
  study.scale.insert(study.scale.end(), more.begin(), more.end());
  return study;
}

ChosenEngine chosen(const StudyFile& study, const StudyModel& model) {
  const auto engine = choose_engine(study, model, [](double) {});
  EXPECT_TRUE(engine) << (engine ? "" : to_string(engine.error().front()));
  return engine ? *engine : ChosenEngine{};
}

// The bound that a study of so many draws states, and how far they are off.
void expect_within_bound(const char* setup, char read, std::uint32_t draws) {
  // An axis that reverses beside a probe is no matter of second order.
  const StudyFile study = fine_cone(setup, read, {{"*:reversal", 0.0}});
  const auto made = make_model(study);
  ASSERT_TRUE(made) << to_string(made.error().front());
  const ChosenEngine engine = chosen(study, **made);
  ASSERT_EQ(engine.kind, EngineKind::linear) << engine.result.reason;
  const auto sampler = Sampler::make(study, **made, engine.kind);
  ASSERT_TRUE(sampler);
  const auto machines = sampler->machines(0, draws);
  const auto full = (*made)->full(machines, {}), linear = (*made)->linear(machines, {});
  double largest_move = 0.0;
  std::vector<double> farthest(study.characteristics.size(), 0.0);
  for (std::size_t d = 0; d < machines.size(); ++d) {
    ASSERT_FALSE(full[d].values.empty()) << full[d].failure;
    largest_move = std::max(largest_move, linear[d].largest_move);
    for (std::size_t c = 0; c < farthest.size(); ++c) {
      farthest[c] = std::max(farthest[c], std::abs(full[d].values[c] - linear[d].values[c]));
    }
  }
  const std::vector<double> bounds = engine.bounds(largest_move);
  for (std::size_t c = 0; c < farthest.size(); ++c) {
    EXPECT_LE(farthest[c], bounds[c]) << study.characteristics[c].name;
    testing::Test::RecordProperty(std::string(setup) + read + study.characteristics[c].name,
                                  fmt::format("{:.4f} of {:.4f}", farthest[c], bounds[c]));
  }
  EXPECT_LE(bounds.front(), 0.032);
}

TEST(StudyEngineLaws, NoWholeMachineIsFartherOffThanTheBoundOfItsStudy) {
  const auto draws = proof::law_count<std::uint32_t>(2000, 100);
  expect_within_bound("proposed", 'R', draws);
  if (proof::laws_are_reduced()) return;
  expect_within_bound("proposed", 'A', draws);
  expect_within_bound("comparison", 'R', draws);
  expect_within_bound("comparison", 'A', draws);
}

// As above, but for errors ten times larger.
TEST(StudyEngine, TakesWholeTrialsOfErrorsTenTimesLarger) {
  StudyFile study = fine_cone("proposed", 'R', {{"*:reversal", 0.0}});
  auto& strategy = study.job->piece.plan.features.front().strategy;
  std::get<metrology::SectionStrategy>(strategy).points_per_section = 36;
  for (studies::ScaleRule& rule : study.scale) rule.factor *= 10.0;
  study.scale.insert(study.scale.begin(), {"*", 10.0});
  const auto made = make_model(study);
  ASSERT_TRUE(made) << to_string(made.error().front());
  const ChosenEngine engine = chosen(study, **made);
  EXPECT_EQ(engine.kind, EngineKind::full);
  EXPECT_THAT(engine.result.reason, HasSubstr("whole trials differ from the linear model by"));
  RecordProperty("reason", engine.result.reason);
}

}  // namespace
}  // namespace frustum::app

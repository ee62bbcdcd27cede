#include "app/study/engine_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace frustum::app {
namespace {

using studies::EngineControls;
using studies::EngineKind;

// Differences below it are those of the numbers: contacts are known to 2 nm.
constexpr double kRounding = 2e-3;  // um
// The draws whose largest motion stands for that of all when `auto` decides.
constexpr std::uint64_t kProbed = 4096;
// As engine_controls.hpp has them: the bound is at least so many times the largest difference, and
// `auto` takes none above this.
constexpr double kBoundOfDifference = 1.5;
constexpr double kLargestBound = 0.05;  // um

struct Controls {
  std::vector<studies::ControlValues> values{};  // by characteristic
  double largest_move = 0.0;
  std::string failure{};
  std::string refusal{};  // after few of them already
};

void take(std::vector<studies::ControlValues>& all, const std::vector<DrawOutcome>& outcomes,
          std::vector<double> studies::ControlValues::*of) {
  for (const DrawOutcome& outcome : outcomes) {
    for (std::size_t c = 0; c < all.size(); ++c) {
      (all[c].*of).push_back(outcome.values.empty() ? 0.0 : outcome.values[c]);
    }
  }
}

using Values = std::vector<double> studies::ControlValues::*;

// The draws from `first` on by both engines, added to what is known of the ones before.
void add_controls(Controls& controls, const StudyModel& model, std::span<const DrawnMachine> drawn,
                  double scale, Values full_values, Values linear_values) {
  const auto full = model.full(drawn, {.scale = scale});
  const auto linear = model.linear(drawn, {.scale = scale});
  for (const auto* outcomes : {&full, &linear}) {
    for (const DrawOutcome& outcome : *outcomes) {
      if (outcome.values.empty()) controls.failure = outcome.failure;
      if (scale != 1.0) continue;
      controls.largest_move = std::max(controls.largest_move, outcome.largest_move);
    }
  }
  take(controls.values, full, full_values);
  take(controls.values, linear, linear_values);
}

// The largest difference of lengths so far: more draws can only make it larger.
double largest_difference(const StudyFile& study, const Controls& controls) {
  double largest = 0.0;
  for (std::size_t c = 0; c < controls.values.size(); ++c) {
    if (study.characteristics[c].angular) continue;
    const studies::ControlValues& of = controls.values[c];
    for (std::size_t i = 0; i < of.full.size(); ++i) {
      largest = std::max(largest, std::abs(of.full[i] - of.linear[i]));
    }
  }
  return largest;
}

// Whole trials are costly: a few draws first, which may decide already.
Controls controls_of(const StudyFile& study, const StudyModel& model, const Sampler& sampler,
                     const std::function<void(double)>& progress) {
  using studies::ControlValues;
  Controls controls;
  controls.values.resize(study.characteristics.size());
  const std::vector<DrawnMachine> drawn = sampler.machines(0, studies::kControls);
  const auto some = std::span(drawn);
  constexpr std::size_t kFew = 8;
  for (const auto& stretch : {some.first(kFew), some.subspan(kFew)}) {
    add_controls(controls, model, stretch, 1.0, &ControlValues::full, &ControlValues::linear);
    progress(stretch.size() == kFew ? 0.1 : 0.5);
    const double least_bound = kBoundOfDifference * largest_difference(study, controls);
    if (!controls.failure.empty() || study.engine != EngineKind::automatic) continue;
    if (least_bound <= kLargestBound) continue;
    controls.refusal = fmt::format(
        "whole trials differ from the linear model by as much as {:.3g} um in the first {} draws: "
        "its bound is above {:g} um",
        least_bound / kBoundOfDifference, controls.values.front().full.size(), kLargestBound);
    return controls;
  }
  if (!controls.failure.empty()) return controls;
  add_controls(controls, model, drawn, 2.0, &ControlValues::full_doubled,
               &ControlValues::linear_doubled);
  progress(1.0);
  return controls;
}

// The largest motion of a point among the first draws.
double largest_move(const StudyModel& model, const Sampler& sampler) {
  double largest = 0.0;
  const studies::FactorSet& factors = model.factors();
  Eigen::VectorXd weights(static_cast<Eigen::Index>(factors.columns().size()));
  for (const DrawnMachine& machine : sampler.machines(0, kProbed)) {
    factors.weights(machine.values, {weights.data(), factors.columns().size()});
    const Eigen::VectorXd moves = model.gains() * weights;
    largest =
        std::max(largest, model.point_count() == 0 ? moves.norm() : moves.cwiseAbs().maxCoeff());
  }
  return largest;
}

std::optional<double> smallest_half_width(const StudyFile& study) {
  std::optional<double> smallest;
  for (const StopRule& rule : study.questions.stop) {
    smallest = std::min(smallest.value_or(rule.half_width), rule.half_width);
  }
  return smallest;
}

ChosenEngine full_because(const StudyModel& model, std::string reason) {
  ChosenEngine engine;
  if (const std::string about = model.about_full(); !about.empty()) {
    reason += (reason.empty() ? "" : "; ") + about;
  }
  engine.result = {.name = "full", .reason = std::move(reason)};
  return engine;
}

Diagnostic refused(const std::string& reason) {
  return error("engine-linear"_id, "the linear engine cannot stand for this study: " + reason,
               "engine = \"full\", or \"auto\", which takes it by itself");
}

}  // namespace

std::vector<double> ChosenEngine::bounds(double largest_of_draws) const {
  std::vector<double> all;
  for (const EngineControls& c : controls) {
    all.push_back(studies::linear_bound(c, largest_of_controls, largest_of_draws));
  }
  return all;
}

Result<ChosenEngine> choose_engine(const StudyFile& study, const StudyModel& model,
                                   const std::function<void(double)>& progress) {
  if (study.engine == EngineKind::full) return full_because(model, "");
  if (const std::string against = model.against_linear(); !against.empty()) {
    if (study.engine == EngineKind::linear) return refused(against);
    return full_because(model, against);
  }
  const auto sampler = Sampler::make(study, model, EngineKind::full);
  if (!sampler) return sampler.error();
  const Controls drawn = controls_of(study, model, *sampler, progress);
  if (!drawn.failure.empty()) {
    const std::string reason = "a control draw failed: " + drawn.failure;
    if (study.engine == EngineKind::linear) return refused(reason);
    return full_because(model, reason);
  }
  if (!drawn.refusal.empty()) {
    ChosenEngine full = full_because(model, drawn.refusal);
    full.result.controls = static_cast<std::uint32_t>(drawn.values.front().full.size());
    return full;
  }
  ChosenEngine engine{.kind = EngineKind::linear, .largest_of_controls = drawn.largest_move};
  // The bound is one of lengths; angles have their own.
  std::vector<studies::ControlValues> lengths;
  for (std::size_t c = 0; c < drawn.values.size(); ++c) {
    engine.controls.push_back(studies::engine_controls({&drawn.values[c], 1}, kRounding));
    if (!study.characteristics[c].angular) lengths.push_back(drawn.values[c]);
  }
  const EngineControls controls =
      studies::engine_controls(lengths.empty() ? drawn.values : lengths, kRounding);
  engine.result = {.name = "linear",
                   .controls = controls.draws,
                   .growth = controls.is_rounding ? 0.0 : controls.growth};
  studies::EngineFacts facts{.controls = controls,
                             .smallest_half_width = smallest_half_width(study)};
  facts.bound = studies::linear_bound(controls, drawn.largest_move, largest_move(model, *sampler));
  if (study.engine == EngineKind::linear) {
    if (!controls.refusal.empty()) return refused(controls.refusal);
    return engine;
  }
  const studies::EngineChoice choice = studies::automatic_engine(facts);
  if (choice.kind == EngineKind::linear) return engine;
  ChosenEngine full = full_because(model, choice.reason);
  full.result.controls = controls.draws;
  full.result.growth = controls.growth;
  return full;
}

}  // namespace frustum::app

#include "app/study/sampler.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "core/units.hpp"
#include "studies/samples/campaign.hpp"

namespace frustum::app {
namespace {

using studies::EngineKind;
using studies::SampleBlock;

// Draws of the engine in lanes take microseconds.
constexpr std::uint64_t kDrawsOfLanes = 16'384;

// How samples show an amount: phases in degrees, places in mm or degrees, others in um or urad.
struct ShownUnit {
  std::string name{};
  double scale = 1.0;
};

ShownUnit shown_unit(const studies::DrawnAmount& amount) {
  const bool is_place = amount.name.starts_with("phases/") || amount.name.starts_with("peaks/");
  switch (amount.unit) {
    case UnitKind::length:
      return is_place ? ShownUnit{"mm", 1.0} : ShownUnit{"um", kUmPerMm};
    case UnitKind::angle:
      return is_place ? ShownUnit{"deg", kDegPerRad} : ShownUnit{"urad", kUradPerRad};
    case UnitKind::none:
      break;
  }
  return {};
}

}  // namespace

Result<studies::Scheme> scheme_of(const StudyFile& study, const StudyModel& model) {
  std::vector<std::uint64_t> streams;
  for (const studies::Variable& v : model.factors().variables()) streams.push_back(v.stream);
  return studies::Scheme::make(study.scheme, study.seed, std::move(streams));
}

Result<Sampler> Sampler::make(const StudyFile& study, const StudyModel& model, EngineKind engine) {
  auto scheme = scheme_of(study, model);
  if (!scheme) return std::move(scheme).error();
  return Sampler(study, model, engine, *std::move(scheme));
}

std::vector<DrawnMachine> Sampler::machines(std::uint64_t first, std::uint64_t count) const {
  const studies::FactorSet& factors = model_->factors();
  std::vector<DrawnMachine> machines(count);
  tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) {
    DrawnMachine& machine = machines[i];
    machine.draw = static_cast<std::uint32_t>(first + i);
    machine.values.resize(factors.variables().size());
    if (scheme_.kind() == studies::SchemeKind::random) {
      factors.draw(study_->seed, machine.draw, machine.values);
    } else {
      std::vector<double> u(machine.values.size());
      scheme_.point(machine.draw, u);
      factors.from_uniform(u, machine.values);
    }
  });
  return machines;
}

void Sampler::add_columns(SampleBlock& block) const {
  for (const StudyCharacteristic& c : study_->characteristics) {
    block.columns.push_back({kCharacteristics + c.name, c.unit(), {}});
  }
  if (study_->keep_amounts) {
    for (const studies::DrawnAmount& amount : model_->factors().amounts()) {
      block.columns.push_back({amount.name, shown_unit(amount).name, {}});
    }
  }
  if (engine_ == EngineKind::linear) block.columns.push_back({kLargestMove, "um", {}});
  for (const StudyCharacteristic& c : study_->characteristics) {
    if (c.limit) block.passes.push_back({kPasses + c.name, {}});
  }
}

// What was drawn, of all rows of the block.
void Sampler::add_amounts(const std::vector<DrawnMachine>& drawn, SampleBlock& block) const {
  auto column = block.columns.begin() + static_cast<std::ptrdiff_t>(study_->characteristics.size());
  for (const studies::DrawnAmount& amount : model_->factors().amounts()) {
    const double scale = shown_unit(amount).scale;
    for (const std::int64_t draw : block.draws) {
      const auto row = static_cast<std::uint64_t>(draw) - block.first_draw;
      column->values.push_back(amount(drawn[row].values) * scale);
    }
    ++column;
  }
}

void Sampler::add_passes(SampleBlock& block) const {
  auto pass = block.passes.begin();
  for (std::size_t c = 0; c < study_->characteristics.size(); ++c) {
    const StudyCharacteristic& of = study_->characteristics[c];
    if (!of.limit) continue;
    for (const double value : block.columns[c].values) {
      pass->values.push_back(of.conforms(value) ? 1 : 0);
    }
    ++pass;
  }
}

SampleBlock Sampler::in_lanes(const studies::LinearEngine& engine, std::uint64_t first,
                              std::uint64_t count) const {
  SampleBlock block{.first_draw = first, .count = count};
  add_columns(block);
  block.draws.resize(count);
  std::iota(block.draws.begin(), block.draws.end(), static_cast<std::int64_t>(first));
  const std::vector<double> values = engine.evaluate(
      scheme_, study_->seed, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count));
  const auto take = [&](std::size_t c, studies::SampleColumn& column) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(c * count);
    column.values.assign(from, from + static_cast<std::ptrdiff_t>(count));
  };
  const std::size_t characteristics = study_->characteristics.size();
  for (std::size_t c = 0; c < characteristics; ++c) take(c, block.columns[c]);
  take(characteristics, block.columns.back());
  add_passes(block);
  if (!study_->keep_amounts && !study_->keep_points) return block;
  const std::vector<DrawnMachine> drawn = machines(first, count);
  if (study_->keep_amounts) add_amounts(drawn, block);
  if (!study_->keep_points) return block;
  block.points = model_->point_count();
  block.deviations.resize(count * block.points);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(count), [&](std::size_t i) {
    std::ranges::copy(model_->linear_points(drawn[i]),
                      block.deviations.begin() + static_cast<std::ptrdiff_t>(i * block.points));
  });
  return block;
}

std::uint64_t Sampler::step() const {
  return engine_ == EngineKind::linear && model_->linear_engine() != nullptr
             ? kDrawsOfLanes
             : studies::kDrawsPerStep;
}

SampleBlock Sampler::sample(std::uint64_t first, std::uint64_t count) const {
  if (const auto* engine = model_->linear_engine();
      engine_ == EngineKind::linear && engine != nullptr) {
    return in_lanes(*engine, first, count);
  }
  SampleBlock block{.first_draw = first, .count = count};
  add_columns(block);
  const std::vector<DrawnMachine> drawn = machines(first, count);
  const EvaluationRequest request{.points = study_->keep_points};
  const std::vector<DrawOutcome> outcomes =
      engine_ == EngineKind::linear ? model_->linear(drawn, request) : model_->full(drawn, request);
  if (study_->keep_points) block.points = model_->point_count();
  for (std::uint64_t i = 0; i < count; ++i) {
    const DrawOutcome& outcome = outcomes[i];
    if (outcome.values.empty()) {
      block.failed.push_back({first + i, outcome.failure});
      continue;
    }
    block.draws.push_back(static_cast<std::int64_t>(first + i));
    auto column = block.columns.begin();
    for (const double value : outcome.values) (column++)->values.push_back(value);
    if (engine_ == EngineKind::linear) block.columns.back().values.push_back(outcome.largest_move);
    if (study_->keep_points && engine_ == EngineKind::linear) {
      const std::vector<double> points = model_->linear_points(drawn[i]);
      block.deviations.insert(block.deviations.end(), points.begin(), points.end());
    }
    block.deviations.insert(block.deviations.end(), outcome.points.begin(), outcome.points.end());
  }
  if (study_->keep_amounts) add_amounts(drawn, block);
  add_passes(block);
  return block;
}

}  // namespace frustum::app

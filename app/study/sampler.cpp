#include "app/study/sampler.hpp"

#include "core/units.hpp"

namespace frustum::app {
namespace {

using studies::EngineKind;
using studies::SampleBlock;

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
  std::vector<double> u(factors.variables().size());
  std::vector<DrawnMachine> machines(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    DrawnMachine& machine = machines[i];
    machine.draw = static_cast<std::uint32_t>(first + i);
    machine.values.resize(u.size());
    if (scheme_.kind() == studies::SchemeKind::random) {
      factors.draw(study_->seed, machine.draw, machine.values);
    } else {
      scheme_.point(machine.draw, u);
      factors.from_uniform(u, machine.values);
    }
  }
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

SampleBlock Sampler::sample(std::uint64_t first, std::uint64_t count) const {
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
    if (study_->keep_amounts) {
      for (const studies::DrawnAmount& amount : model_->factors().amounts()) {
        (column++)->values.push_back(amount(drawn[i].values) * shown_unit(amount).scale);
      }
    }
    if (engine_ == EngineKind::linear) column->values.push_back(outcome.largest_move);
    auto pass = block.passes.begin();
    for (std::size_t c = 0; c < study_->characteristics.size(); ++c) {
      const StudyCharacteristic& of = study_->characteristics[c];
      if (of.limit) (pass++)->values.push_back(of.conforms(outcome.values[c]) ? 1 : 0);
    }
    block.deviations.insert(block.deviations.end(), outcome.points.begin(), outcome.points.end());
  }
  return block;
}

}  // namespace frustum::app

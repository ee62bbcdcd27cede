#include "app/study/study_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/study/place_in_file.hpp"
#include "app/study/study_map.hpp"
#include "app/study/study_shares.hpp"
#include "app/study/volumetric_model.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::app {
namespace {

using studies::CharacteristicResult;
using studies::StudyResult;

// The block or replicate of each draw; empty for random draws, whose order statistics have
// intervals of their own.
std::vector<std::uint32_t> groups_of(const studies::Scheme& scheme, const SampleColumns& samples) {
  std::vector<std::uint32_t> groups;
  if (scheme.kind() == studies::SchemeKind::random) return groups;
  const std::uint64_t count = samples.draws.size() + samples.failed.size();
  const std::uint32_t whole = scheme.whole_groups(count);
  for (const std::int64_t draw : samples.draws) {
    const auto group = scheme.group_of(static_cast<std::uint32_t>(draw));
    groups.push_back(group && *group < whole ? *group : studies::kNoGroup);
  }
  return groups;
}

std::uint64_t conforming(const std::vector<double>& values, const StudyCharacteristic& c,
                         double limit) {
  StudyCharacteristic at = c;
  at.limit = limit;
  return static_cast<std::uint64_t>(
      std::ranges::count_if(values, [&](double v) { return at.conforms(v); }));
}

double uncertainty_of(const StudyFile& study, const StudyModel& model, std::size_t c) {
  if (study.measurement.u && !study.characteristics[c].angular) return *study.measurement.u;
  return model.measuring_uncertainty(c);
}

std::vector<studies::RiskResult> risks_of(const StudyFile& study, const StudyModel& model,
                                          std::size_t c, const std::vector<double>& values) {
  std::vector<studies::RiskResult> risks;
  const StudyCharacteristic& of = study.characteristics[c];
  const double u = uncertainty_of(study, model, c);
  if (!of.limit || !(u > 0.0) || values.empty()) return risks;
  for (const studies::DecisionRule& rule : study.questions.rules) {
    const double limit = studies::acceptance_limit(rule, values, u, *of.limit, of.both_sides);
    risks.push_back(
        {.rule = rule.written,
         .acceptance_limit = limit,
         .risks = studies::risks_of_sample(values, u, studies::within(*of.limit, of.both_sides),
                                           studies::within(limit, of.both_sides))});
  }
  return risks;
}

void add_conformity(CharacteristicResult& result, const StudyCharacteristic& c,
                    const std::vector<double>& values, std::uint64_t count, double bound) {
  result.limit = c.limit;
  result.both_sides = c.both_sides;
  if (!c.limit || count == 0) return;
  result.conform = studies::proportion(conforming(values, c, *c.limit), count);
  if (!(bound > 0.0)) return;
  result.conform_low = studies::proportion(conforming(values, c, *c.limit - bound), count);
  result.conform_high = studies::proportion(conforming(values, c, *c.limit + bound), count);
}

studies::Proportion joint_of(const StudyFile& study, const SampleColumns& samples,
                             std::uint64_t count) {
  std::vector<const std::vector<double>*> columns;
  for (const StudyCharacteristic& c : study.characteristics) {
    columns.push_back(samples.find(kCharacteristics + c.name));
  }
  std::uint64_t k = 0;
  for (std::size_t row = 0; row < samples.draws.size(); ++row) {
    bool all = true;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      all = all && (columns[c] == nullptr || study.characteristics[c].conforms((*columns[c])[row]));
    }
    if (all) ++k;
  }
  return studies::proportion(k, count);
}

void add_unreached(const StudyFile& study, const studies::Scheme& scheme,
                   const SampleColumns& samples, StudyResult& result) {
  const double at_least = study.questions.at_least;
  for (const CharacteristicResult& c : result.characteristics) {
    if (at_least > 0.0 && c.conform && c.conform->p < at_least) {
      result.not_reached.push_back(
          fmt::format("P({} conforms) = {:.4f} is below {:g}", c.name, c.conform->p, at_least));
    }
  }
  const auto states = stop_states(study, scheme, samples);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].reached) continue;
    const StopRule& rule = study.questions.stop[i];
    result.not_reached.push_back(
        states[i].half_width ? fmt::format("{} is known to +-{:.4g}, asked for was {:g}",
                                           rule.written, *states[i].half_width, rule.half_width)
                             : fmt::format("{} has no interval with so few draws", rule.written));
  }
}

}  // namespace

std::vector<StopState> stop_states(const StudyFile& study, const studies::Scheme& scheme,
                                   const SampleColumns& samples) {
  std::vector<StopState> states;
  const std::vector<std::uint32_t> groups = groups_of(scheme, samples);
  for (const StopRule& rule : study.questions.stop) {
    StopState& state = states.emplace_back();
    const auto* values =
        samples.find(kCharacteristics + study.characteristics[rule.characteristic].name);
    if (values == nullptr || values->size() < 2) continue;
    const double p[] = {rule.quantile.value_or(0.5)};
    const studies::Summary summary = studies::summary_of(*values, p, groups);
    // Of a mean: 1.96 standard errors.
    constexpr double kNormal95 = 1.959963984540054;
    state.half_width = rule.quantile ? studies::half_width(summary.quantiles.front().ci95)
                                     : std::optional(kNormal95 * summary.mean_se);
    state.reached = state.half_width && *state.half_width <= rule.half_width;
  }
  return states;
}

Diagnostics unanswerable(const StudyFile& study, const StudyModel& model) {
  Diagnostics problems;
  if (!study.questions.rules.empty()) {
    bool any = false;
    for (std::size_t c = 0; c < study.characteristics.size(); ++c) {
      any = any || (study.characteristics[c].limit && uncertainty_of(study, model, c) > 0.0);
    }
    if (!any) {
      problems.push_back(error("no-uncertainty"_id,
                               "risks need a limit and a measuring uncertainty, and there is none",
                               "[measurement] u = \"0.6 um\", or a CMM with its e0 in the job"));
    }
  }
  if (const auto scheme = scheme_of(study, model); !scheme) {
    for (const Diagnostic& problem : scheme.error()) {
      problems.push_back(at_key(study.file, "", "scheme", problem).value_or(problem));
    }
  }
  std::ranges::move(unanswerable_shares(study, model), std::back_inserter(problems));
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = study.file.string();
  }
  return problems;
}

Result<StudyResult> result_of(const StudyFile& study, const StudyModel& model,
                              const ChosenEngine& engine, const SampleColumns& samples,
                              std::uint64_t count) {
  const auto scheme = scheme_of(study, model);
  if (!scheme) return scheme.error();
  StudyResult result{.title = study.title,
                     .seed = study.seed,
                     .scheme = std::string(studies::name_of(study.scheme)),
                     .samples = count,
                     .engine = engine.result};
  for (const studies::FailedSample& failed : samples.failed) {
    result.failed.push_back({static_cast<std::uint32_t>(failed.draw), failed.message});
  }
  std::vector<double> bounds(study.characteristics.size(), 0.0);
  if (const auto* moves = samples.find(kLargestMove); moves != nullptr && !moves->empty()) {
    bounds = engine.bounds(*std::ranges::max_element(*moves));
    for (std::size_t c = 0; c < bounds.size(); ++c) {
      if (study.characteristics[c].angular) continue;
      result.engine.bound_um = std::max(result.engine.bound_um, bounds[c]);
    }
  }
  const std::vector<std::uint32_t> groups = groups_of(*scheme, samples);
  bool has_limit = false;
  for (std::size_t i = 0; i < study.characteristics.size(); ++i) {
    const StudyCharacteristic& c = study.characteristics[i];
    const auto* found = samples.find(kCharacteristics + c.name);
    const std::vector<double> none;
    const std::vector<double>& values = found == nullptr ? none : *found;
    CharacteristicResult of{.name = c.name, .unit = c.unit()};
    if (!values.empty()) of.summary = studies::summary_of(values, studies::kQuantiles, groups);
    add_conformity(of, c, values, count, bounds[i]);
    of.risks = risks_of(study, model, i, values);
    of.exact = exact_length(model, c.limit);
    has_limit = has_limit || c.limit.has_value();
    result.characteristics.push_back(std::move(of));
  }
  if (has_limit && count > 0) result.joint = joint_of(study, samples, count);
  add_shares(study, model, result);
  auto map = map_of(study);
  if (!map) return map.error();
  result.map = *std::move(map);
  add_unreached(study, *scheme, samples, result);
  return result;
}

}  // namespace frustum::app

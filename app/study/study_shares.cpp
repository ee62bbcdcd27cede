#include "app/study/study_shares.hpp"

#include <algorithm>
#include <numeric>

#include "app/study/place_in_file.hpp"
#include "app/study/sampler.hpp"
#include "core/units.hpp"
#include "studies/answers/allocation.hpp"

namespace frustum::app {
namespace {

using studies::FactorGroup;
using studies::StudyResult;

// Draws of the total and first-order indices, times groups and two.
constexpr std::uint32_t kShareDraws = 8192;
// Draws on which tolerances are allocated.
constexpr std::uint64_t kAllocationDraws = 32'768;

std::size_t asked_characteristic(const StudyFile& study, const std::string& name) {
  return name.empty() ? 0 : place_of(study.characteristics, name).value_or(0);
}

Diagnostic no_linear_view(const StudyFile& study, std::size_t c) {
  return error("not-linear"_id,
               "shares and tolerances of " + study.characteristics[c].name +
                   " cannot be computed: it is not a range or a length of what moves in "
                   "proportion to the errors",
               "ask for a form of one section, a half angle or a size");
}

// Values of the characteristic for rows of all variables.
studies::DrawFunction function_of(const StudyModel& model, const LinearView& view) {
  return [&model, &view](std::span<const double> values, std::span<double> results) {
    const studies::FactorSet& factors = model.factors();
    const std::size_t variables = factors.variables().size(), columns = factors.columns().size();
    std::vector<double> weights(results.size() * columns);
    for (std::size_t d = 0; d < results.size(); ++d) {
      factors.weights(values.subspan(d * variables, variables),
                      std::span(weights).subspan(d * columns, columns));
    }
    std::ranges::copy(view.values(weights), results.begin());
  };
}

studies::SharesResult shares_of(const StudyFile& study, const StudyModel& model, std::size_t c,
                                const LinearView& view, const std::vector<FactorGroup>& groups) {
  const auto squares = studies::mean_square_shares(view.gains, model.factors(), groups);
  const auto indices = studies::sobol_indices(model.factors(), groups, study.seed, kShareDraws,
                                              function_of(model, view));
  studies::SharesResult shares{.characteristic = study.characteristics[c].name,
                               .draws = kShareDraws};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const studies::SobolIndex& index = indices.groups[g];
    shares.groups.push_back({groups[g].name, squares.shares[g], index.first, index.first_se,
                             index.total, index.total_se});
  }
  std::ranges::stable_sort(shares.groups, std::ranges::greater{}, &studies::ShareResult::total);
  return shares;
}

// Values of the study's first draws when each group's errors are scaled.
class ScaledDraws {
 public:
  ScaledDraws(const StudyFile& study, const StudyModel& model, const LinearView& view,
              const std::vector<FactorGroup>& groups)
      : view_(view),
        columns_(model.factors().columns().size()),
        group_of_(columns_, groups.size()) {
    const auto sampler = Sampler::make(study, model, studies::EngineKind::linear);
    const std::uint64_t count = std::min(study.samples, kAllocationDraws);
    if (!sampler) return;  // the study's own draws were made by the same scheme
    for (const DrawnMachine& machine : sampler->machines(0, count)) {
      weights_.resize(weights_.size() + columns_);
      model.factors().weights(machine.values,
                              std::span(weights_).subspan(weights_.size() - columns_));
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const std::size_t factor : groups[g].factors) {
        for (const std::size_t j : model.factors().factors()[factor].columns) group_of_[j] = g;
      }
    }
  }

  [[nodiscard]] std::vector<double> operator()(std::span<const double> factors) const {
    std::vector<double> scaled = weights_;
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      const std::size_t g = group_of_[i % columns_];
      if (g < factors.size()) scaled[i] *= factors[g];
    }
    return view_.values(scaled);
  }

 private:
  const LinearView& view_;
  std::size_t columns_;
  std::vector<std::size_t> group_of_;
  std::vector<double> weights_{};
};

studies::AllocationResult allocation_of(const StudyFile& study, const StudyModel& model,
                                        std::size_t c, const LinearView& view,
                                        const std::vector<FactorGroup>& groups) {
  const AllocationRequest& request = *study.questions.allocation;
  studies::AllocationResult result{.characteristic = study.characteristics[c].name,
                                   .probability = request.probability};
  std::vector<double> costs;
  for (const FactorGroup& group : groups) {
    result.groups.push_back(group.name);
    const auto cost = request.cost.find(group.name);
    costs.push_back(cost == request.cost.end() ? 1.0 : cost->second);
  }
  const ScaledDraws draws(study, model, view, groups);
  const double limit = *study.characteristics[c].limit;
  const auto allocation = studies::allocate(draws, costs, request.probability, limit);
  result.factors = allocation.factors;
  result.cost = allocation.cost;
  result.equal_factor = allocation.equal_factor;
  result.equal_cost = allocation.equal_cost;
  std::vector<double> sorted = draws(std::vector<double>(groups.size(), 1.0));
  std::ranges::sort(sorted);
  result.equal_factor_ci95 = studies::one_factor(sorted, request.probability, limit).ci95;
  return result;
}

Result<std::vector<FactorGroup>> share_groups(const StudyFile& study, const StudyModel& model) {
  if (study.questions.groups.empty()) return studies::groups_by_entry(model.factors());
  return studies::groups_named(study.machine(), model.factors(), study.questions.groups);
}

}  // namespace

Diagnostics unanswerable_shares(const StudyFile& study, const StudyModel& model) {
  Diagnostics problems;
  const auto note = [&](std::string_view table, std::string_view key, const Diagnostic& problem) {
    problems.push_back(at_key(study.file, table, key, problem).value_or(problem));
  };
  const StudyQuestions& asked = study.questions;
  if (const auto groups = share_groups(study, model); !groups) {
    for (const Diagnostic& problem : groups.error()) note("shares", "groups", problem);
  }
  if (asked.shares) {
    const std::size_t c = asked_characteristic(study, asked.share_characteristic);
    if (!model.linear_view(c)) note("shares", "characteristic", no_linear_view(study, c));
  }
  if (asked.allocation) {
    const std::size_t c = asked_characteristic(study, asked.allocation->characteristic);
    if (!model.linear_view(c)) note("allocate", "characteristic", no_linear_view(study, c));
    if (!study.characteristics[c].limit) {
      note("allocate", "characteristic",
           error("no-limit"_id,
                 study.characteristics[c].name + " has no limit to allocate tolerances for",
                 "give it one in [limits]"));
    }
  }
  return problems;
}

void add_shares(const StudyFile& study, const StudyModel& model, StudyResult& result) {
  const StudyQuestions& asked = study.questions;
  if (!asked.shares && !asked.allocation) return;
  const auto groups = share_groups(study, model);
  if (!groups) return;
  if (asked.shares) {
    const std::size_t c = asked_characteristic(study, asked.share_characteristic);
    if (const auto view = model.linear_view(c)) {
      result.shares.push_back(shares_of(study, model, c, *view, *groups));
    }
  }
  if (asked.allocation) {
    const std::size_t c = asked_characteristic(study, asked.allocation->characteristic);
    const auto view = model.linear_view(c);
    if (view && study.characteristics[c].limit) {
      result.allocation = allocation_of(study, model, c, *view, *groups);
    }
  }
}

}  // namespace frustum::app

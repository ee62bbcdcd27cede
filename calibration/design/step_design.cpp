#include "calibration/design/step_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/spelling.hpp"

namespace frustum::calibration {
namespace {

// The two that cut the same surfaces (programs::cut_the_same_surfaces).
constexpr const char* kFirst = "3";
constexpr const char* kAlternative = "4";

bool contains(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::vector<std::string> names_of(const StepCatalogue& catalogue) {
  std::vector<std::string> names;
  for (const DesignBlock& pattern : catalogue.patterns) names.push_back(pattern.name);
  return names;
}

// Names that are no pattern, or none that can be chosen here.
Diagnostics wrong_names(const StepCatalogue& catalogue, const StepDesignOptions& options) {
  const std::vector<std::string> reachable = names_of(catalogue);
  Diagnostics wrong;
  for (const auto* list : {&options.among, &options.required}) {
    for (const std::string& name : *list) {
      if (contains(reachable, name)) continue;
      const auto out = std::find_if(catalogue.unreachable.begin(), catalogue.unreachable.end(),
                                    [&](const auto& u) { return u.pattern == name; });
      wrong.push_back(out != catalogue.unreachable.end()
                          ? error("unknown-pattern"_id, out->reason, "leave the pattern out")
                          : error("unknown-pattern"_id,
                                  fmt::format("there is no pattern '{}'", name),
                                  suggestion(name, reachable)));
    }
  }
  if (options.among.empty()) return wrong;
  for (const std::string& name : options.required) {
    if (!contains(options.among, name) && contains(reachable, name)) {
      wrong.push_back(
          error("unknown-pattern"_id,
                fmt::format("pattern {} is required but not among those to choose from", name),
                "add it to the patterns, or do not require it"));
    }
  }
  return wrong;
}

// Unknowns that the catalogue identifies one after the other; the rest by name.
struct Kept {
  std::vector<Unknown> unknowns{};
  std::vector<Cause> causes{};
  std::vector<std::string> left_out{};
};
Result<Kept> independent(const StepCatalogue& catalogue, const std::vector<Cause>& causes) {
  const auto& unknowns = catalogue.observations.unknowns;
  const auto identified = independent_unknowns(catalogue.observations);
  if (!identified) return identified.error();
  Kept kept;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const bool is_told = std::find(identified->begin(), identified->end(),
                                   static_cast<Eigen::Index>(k)) != identified->end();
    if (is_told || unknowns[k].is_fixed()) {
      kept.unknowns.push_back(unknowns[k]);
      kept.causes.push_back(causes[k]);
    } else {
      kept.left_out.push_back(unknowns[k].name);
    }
  }
  return kept;
}

// One way to place pattern 4: which patterns there are to choose from, and on what workpiece.
class Placing {
 public:
  Placing(StepCatalogue catalogue, Pattern4 pattern_4, const StepDesignOptions& options)
      : catalogue_(std::move(catalogue)), pattern_4_(pattern_4), options_(options) {
    for (std::size_t i = 0; i < catalogue_.patterns.size(); ++i) {
      const std::string& name = catalogue_.patterns[i].name;
      if (!options.among.empty() && !contains(options.among, name)) continue;
      blocks_.push_back(catalogue_.patterns[i]);
      workpiece_.push_back(catalogue_.workpiece[i]);
    }
  }

  // Nothing to choose: this way of placing is of no use.
  [[nodiscard]] bool is_empty() const {
    if (pattern_4_ == Pattern4::on_its_own) return blocks_.empty();
    return !place_of(kAlternative) || contains(options_.required, kFirst);  // 3 has no place here
  }

  [[nodiscard]] Result<DesignResult> result() const {
    DesignOptions options;
    options.criterion = options_.criterion;
    for (const std::string& name : options_.required) {
      if (const auto place = place_of(name)) options.required.push_back(*place);
    }
    const auto first = place_of(kFirst), alternative = place_of(kAlternative);
    if (pattern_4_ == Pattern4::in_the_place_of_3) {
      options.required.push_back(*alternative);
    } else if (alternative && first) {
      options.needs.emplace_back(*alternative, *first);
    } else if (alternative) {
      options.exclusive.emplace_back(*alternative, *alternative);  // never: it has 3's place
    }
    for (const Unknown& unknown : catalogue_.observations.unknowns) {
      const auto limit = options_.limits.find(unknown.name);
      options.limits.push_back(limit == options_.limits.end() ? std::optional<double>()
                                                              : std::optional(limit->second));
    }
    return design(catalogue_.observations, selectable(), options);
  }

  // The choice with names, and places in `all`.
  [[nodiscard]] StepChoice named(DesignChoice choice, const std::vector<std::string>& all) const {
    StepChoice found;
    std::set<int> workpieces;
    for (std::size_t& block : choice.blocks) {
      const std::string& name = selectable()[block].name;
      workpieces.insert(workpiece_[block]);
      found.patterns.push_back(name);
      block = static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
    }
    found.workpieces = workpieces.size();
    found.choice = std::move(choice);
    return found;
  }

  [[nodiscard]] const std::vector<DesignBlock>& selectable() const { return blocks_; }
  [[nodiscard]] const StepCatalogue& catalogue() const { return catalogue_; }

 private:
  [[nodiscard]] std::optional<std::size_t> place_of(std::string_view name) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (blocks_[i].name == name) return i;
    }
    return std::nullopt;
  }

  StepCatalogue catalogue_;
  Pattern4 pattern_4_;
  const StepDesignOptions& options_;
  std::vector<DesignBlock> blocks_{};
  std::vector<int> workpiece_{};
};

// Takes what another way of placing found into the design.
void merge(StepDesign& design, const Placing& placing, DesignResult result) {
  design.free_unknowns = result.unknowns;
  for (std::size_t i = 0; i < result.best_of_size.size(); ++i) {
    StepChoice choice = placing.named(std::move(result.best_of_size[i]), design.patterns);
    const std::size_t size = choice.patterns.size();
    const auto at = std::find_if(design.best_of_size.begin(), design.best_of_size.end(),
                                 [&](const StepChoice& c) { return c.patterns.size() >= size; });
    const auto place = at - design.best_of_size.begin();
    if (at == design.best_of_size.end() || at->patterns.size() != size) {
      design.best_of_size.insert(at, std::move(choice));
      design.identifying_sets.insert(design.identifying_sets.begin() + place,
                                     result.identifying_sets[i]);
      continue;
    }
    design.identifying_sets[static_cast<std::size_t>(place)] += result.identifying_sets[i];
    if (better(choice.choice, at->choice)) *at = std::move(choice);
  }
  if (result.smallest) {
    StepChoice smallest = placing.named(std::move(*result.smallest), design.patterns);
    const bool fewer =
        !design.smallest || smallest.patterns.size() < design.smallest->patterns.size();
    const bool as_few =
        design.smallest && smallest.patterns.size() == design.smallest->patterns.size();
    if (fewer || (as_few && better(smallest.choice, design.smallest->choice))) {
      design.smallest = std::move(smallest);
    }
  }
  for (const auto& set : result.smallest_identifying) {
    std::vector<std::string> names;
    names.reserve(set.size());
    for (const std::size_t block : set) names.push_back(placing.selectable()[block].name);
    auto& known = design.smallest_identifying;
    if (!known.empty() && names.size() < known.front().size()) known.clear();
    if (known.empty() || names.size() == known.front().size()) known.push_back(std::move(names));
  }
}

std::vector<NullDirection> null_space_of(const Placing& placing) {
  std::vector<Eigen::Index> rows;
  for (const DesignBlock& pattern : placing.selectable()) {
    rows.insert(rows.end(), pattern.rows.begin(), pattern.rows.end());
  }
  if (rows.empty()) return {};
  const auto identified = observability(placing.catalogue().observations.selected(rows));
  return identified ? identified->null_space : std::vector<NullDirection>{};
}

}  // namespace

Result<StepDesign> step_design(const kinematics::Machine& machine, std::vector<Unknown> unknowns,
                               std::vector<Cause> causes, const metrology::CmmModel& cmm,
                               const CatalogueSetup& setup, const StepDesignOptions& options) {
  auto catalogue = step_catalogue(machine, unknowns, causes, cmm, setup);
  if (!catalogue) return std::move(catalogue).error();
  if (Diagnostics wrong = wrong_names(*catalogue, options); !wrong.empty()) return wrong;
  StepDesign design;
  if (options.leave_out_dependent) {
    auto kept = independent(*catalogue, causes);
    if (!kept) return std::move(kept).error();
    if (!kept->left_out.empty()) {
      unknowns = std::move(kept->unknowns);
      causes = std::move(kept->causes);
      design.left_out = std::move(kept->left_out);
      catalogue = step_catalogue(machine, unknowns, causes, cmm, setup);
      if (!catalogue) return std::move(catalogue).error();
    }
  }
  design.unknowns = catalogue->observations.unknowns;
  design.unreachable = catalogue->unreachable;
  const Placing beside(*std::move(catalogue), Pattern4::on_its_own, options);
  for (const DesignBlock& pattern : beside.selectable()) design.patterns.push_back(pattern.name);
  if (!beside.is_empty()) {
    auto result = beside.result();
    if (!result) return std::move(result).error();
    merge(design, beside, *std::move(result));
  }
  auto other = step_catalogue(machine, unknowns, causes, cmm, setup, Pattern4::in_the_place_of_3);
  if (!other) return std::move(other).error();
  const Placing instead(*std::move(other), Pattern4::in_the_place_of_3, options);
  if (!instead.is_empty()) {
    auto result = instead.result();
    if (!result) return std::move(result).error();
    merge(design, instead, *std::move(result));
  }
  std::sort(design.smallest_identifying.begin(), design.smallest_identifying.end());
  design.null_space = null_space_of(beside);
  return design;
}

}  // namespace frustum::calibration

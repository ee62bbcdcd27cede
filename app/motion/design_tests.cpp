#include "app/motion/design_tests.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "app/job/identification.hpp"
#include "app/job/named_amount.hpp"
#include "app/motion/document.hpp"
#include "app/motion/measured_motion.hpp"
#include "app/view/shown_unit.hpp"
#include "app/view/text_table.hpp"
#include "calibration/design/test_design.hpp"

namespace frustum::app {
namespace {

using calibration::DesignChoice;
using calibration::TestDesign;

std::vector<std::string> tests_of(const TestDesign& design, const DesignChoice& choice) {
  std::vector<std::string> names;
  for (const std::size_t block : choice.blocks) names.push_back(design.tests[block]);
  return names;
}

Document choice_document(const TestDesign& design, const DesignChoice& choice) {
  Document deviations;
  for (std::size_t k = 0; k < design.unknowns.size(); ++k) {
    std::optional<double> deviation = choice.standard_deviations[k];
    if (deviation) *deviation = shown(*deviation, design.unknowns[k].angular);
    deviations[design.unknowns[k].name] = deviation;
  }
  return {{"tests", tests_of(design, choice)},
          {"rank", static_cast<std::uint64_t>(choice.rank)},
          {"identifies_all", std::string(choice.identifies_all ? "yes" : "no")},
          {"log_det", choice.log_det},
          {"standard_deviations", deviations}};
}

std::string design_tests_text(const TestDesign& design) {
  TextTable sets(
      {"tests", "number", "identified", "log det", "sets of the size that identify all"});
  for (std::size_t i = 0; i < design.result.best_of_size.size(); ++i) {
    const DesignChoice& c = design.result.best_of_size[i];
    sets.row({fmt::format("{}", fmt::join(tests_of(design, c), ", ")),
              fmt::format("{}", c.blocks.size()),
              fmt::format("{} of {}", c.rank, design.result.unknowns),
              c.log_det ? fmt::format("{:.2f}", *c.log_det) : "-",
              fmt::format("{}", design.result.identifying_sets[i])});
  }
  std::string out = "Best set of each size\n" + sets.text();
  const auto& smallest = design.result.smallest;
  out += smallest ? fmt::format("\nSmallest set that identifies all: {}\n",
                                fmt::join(tests_of(design, *smallest), ", "))
                  : std::string("\nNo set of these tests identifies all errors.\n");
  for (const auto& direction : design.null_space) out += "  " + direction.text + "\n";
  const DesignChoice& last = smallest ? *smallest : design.result.best_of_size.back();
  TextTable deviations({"error", "unit", "standard deviation"});
  for (std::size_t k = 0; k < design.unknowns.size(); ++k) {
    const auto& deviation = last.standard_deviations[k];
    const bool angular = design.unknowns[k].angular;
    deviations.row({design.unknowns[k].name, shown_unit(angular).name,
                    deviation ? fmt::format("{:.3g}", shown(*deviation, angular)) : "-"});
  }
  return out + "\nExpected of that set\n" + deviations.text();
}

Result<TestDesign> design_of(const Study& study, const TestDesignWords& words) {
  const auto all = unknown_causes(study.machine(), study.unknowns, study.known);
  if (!all) return all.error();
  calibration::TestDesignOptions options{.criterion = words.criterion, .required = words.required};
  for (const std::string& text : words.limits) {
    const auto limit = named_amount(study.machine(), text, "--limit");
    if (!limit) return limit.error();
    const bool is_unknown =
        std::ranges::any_of(all->unknowns, [&](const auto& u) { return u.name == limit->name; });
    if (!is_unknown) {
      return error("unknown-error"_id,
                   fmt::format("--limit {}: not one of the unknowns", limit->name),
                   "add it to unknown.errors of the study");
    }
    options.limits[limit->name] = limit->amount;
  }
  return calibration::test_design(study.machine(), study.motions, all->unknowns, all->causes,
                                  options);
}

}  // namespace

int show_test_design(const TestDesignWords& words) {
  const auto study = load_study(words.study, read_planned_motion);
  if (!study) return refuse(study.error(), words);
  if (study->motions.empty()) {
    return refuse({error("nothing-measured"_id, "the study has no motion tests to choose from",
                         "[[motion]] with test and noise; step patterns: frustum design MACHINE")},
                  words);
  }
  const auto design = design_of(*study, words);
  if (!design) return refuse(design.error(), words);
  if (words.json) {
    Document doc{{"schema", "frustum/test-design/1"},
                 {"machine", study->machine().name()},
                 {"tests", design->tests}};
    Document sizes;
    for (const DesignChoice& choice : design->result.best_of_size) {
      sizes[fmt::format("{}", choice.blocks.size())] = choice_document(*design, choice);
    }
    doc["best_of_size"] = sizes;
    if (design->result.smallest)
      doc["smallest"] = choice_document(*design, *design->result.smallest);
    std::vector<std::string> nulls;
    for (const auto& direction : design->null_space) nulls.push_back(direction.text);
    doc["null_space"] = nulls;
    std::cout << doc.json() << '\n';
  } else if (!words.quiet) {
    std::cout << study->machine().title() << '\n' << design_tests_text(*design);
  }
  return design->result.smallest ? kDone : kOutOfTolerance;
}

}  // namespace frustum::app

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
#include "core/program_version.hpp"

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
          {"hours", choice.cost},
          {"bits", choice.bits},
          {"standard_deviations", deviations}};
}

// What each of them takes and tells by itself.
Document items_document(const TestDesign& design) {
  Document items;
  for (std::size_t i = 0; i < design.tests.size(); ++i) {
    const DesignChoice& alone = design.result.alone[i];
    items[design.tests[i]] = Document{{"machine_hours", design.hours[i].machine},
                                      {"cmm_hours", design.hours[i].cmm},
                                      {"rank", static_cast<std::uint64_t>(alone.rank)},
                                      {"bits", alone.bits},
                                      {"bits_per_hour", alone.bits / design.hours[i].all()}};
  }
  return items;
}

std::string items_text(const TestDesign& design) {
  TextTable items({"alone", "machine, h", "CMM, h", "identified", "bits", "bits/h"});
  for (std::size_t i = 0; i < design.tests.size(); ++i) {
    const DesignChoice& alone = design.result.alone[i];
    const calibration::Hours& hours = design.hours[i];
    items.row({design.tests[i], fmt::format("{:.2f}", hours.machine),
               fmt::format("{:.2f}", hours.cmm),
               fmt::format("{} of {}", alone.rank, design.result.unknowns),
               fmt::format("{:.1f}", alone.bits), fmt::format("{:.1f}", alone.bits / hours.all())});
  }
  return items.text();
}

std::string sets_text(const TestDesign& design) {
  TextTable sets({"tests", "number", "hours", "identified", "bits", "log det",
                  "sets of the size that identify all"});
  for (std::size_t i = 0; i < design.result.best_of_size.size(); ++i) {
    const DesignChoice& c = design.result.best_of_size[i];
    sets.row({fmt::format("{}", fmt::join(tests_of(design, c), ", ")),
              fmt::format("{}", c.blocks.size()), fmt::format("{:.2f}", c.cost),
              fmt::format("{} of {}", c.rank, design.result.unknowns),
              fmt::format("{:.1f}", c.bits), c.log_det ? fmt::format("{:.2f}", *c.log_det) : "-",
              fmt::format("{}", design.result.identifying_sets[i])});
  }
  return "\nBest set of each size\n" + sets.text();
}

std::string expected_text(const TestDesign& design, const DesignChoice& choice) {
  TextTable deviations({"error", "unit", "standard deviation"});
  for (std::size_t k = 0; k < design.unknowns.size(); ++k) {
    const auto& deviation = choice.standard_deviations[k];
    const bool angular = design.unknowns[k].angular;
    deviations.row({design.unknowns[k].name, shown_unit(angular).name,
                    deviation ? fmt::format("{:.3g}", shown(*deviation, angular)) : "-"});
  }
  return "\nExpected of that set\n" + deviations.text();
}

std::string design_tests_text(const TestDesign& design, const std::optional<double>& budget) {
  std::string out = items_text(design) + sets_text(design);
  const auto& smallest = design.result.smallest;
  out += smallest ? fmt::format("\nSmallest set that identifies all: {}\n",
                                fmt::join(tests_of(design, *smallest), ", "))
                  : std::string("\nNo set of these tests identifies all errors.\n");
  for (const auto& direction : design.null_space) out += "  " + direction.text + "\n";
  if (!budget) {
    return out + expected_text(design, smallest ? *smallest : design.result.best_of_size.back());
  }
  const auto& within = design.result.within_budget;
  if (!within) {
    return out + fmt::format("\nNothing that may be chosen is done in {:g} h.\n", *budget);
  }
  return out +
         fmt::format("\nBest set within {:g} h: {} ({:.2f} h, {} of {} identified, {:.1f} bits)\n",
                     *budget, fmt::join(tests_of(design, *within), ", "), within->cost,
                     within->rank, design.result.unknowns, within->bits) +
         expected_text(design, *within);
}

Result<std::vector<calibration::CandidatePiece>> candidate_pieces(const Study& study) {
  auto measured = pieces_of(study);
  if (!measured) return std::move(measured).error();
  std::vector<calibration::CandidatePiece> pieces;
  for (std::size_t i = 0; i < measured->size(); ++i) {
    const StudyPart& part = study.parts[i];
    calibration::MeasuredPiece& piece = (*measured)[i];
    if (!piece.cmm) piece.cmm = ordinary_cmm();
    pieces.push_back({{std::move(piece), part.rows}, part.hours});
  }
  return pieces;
}

Result<TestDesign> design_of(const Study& study, const TestDesignWords& words) {
  auto all = unknown_causes(study.machine(), study.unknowns, study.known);
  if (!all) return all.error();
  add_tool_radius(study, *all);
  calibration::TestDesignOptions options{
      .criterion = words.criterion, .required = words.required, .budget = words.hours};
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
  const auto pieces = candidate_pieces(study);
  if (!pieces) return pieces.error();
  std::vector<calibration::CandidateMotion> motions;
  for (std::size_t i = 0; i < study.motions.size(); ++i) {
    motions.push_back({study.motions[i], study.motion_hours[i]});
  }
  return calibration::test_design(study.machine(), *pieces, motions, all->unknowns, all->causes,
                                  study.times, options);
}

}  // namespace

int show_test_design(const TestDesignWords& words) {
  const auto study = load_study(words.study, read_planned_motion, true);
  if (!study) return refuse(study.error(), words);
  const auto design = design_of(*study, words);
  if (!design) return refuse(design.error(), words);
  if (words.json) {
    Document doc{{"schema", "frustum/test-design/1"},
                 {"version", program_version()},
                 {"machine", study->machine().name()},
                 {"tests", design->tests},
                 {"items", items_document(*design)}};
    Document sizes;
    for (const DesignChoice& choice : design->result.best_of_size) {
      sizes[fmt::format("{}", choice.blocks.size())] = choice_document(*design, choice);
    }
    doc["best_of_size"] = sizes;
    if (design->result.smallest)
      doc["smallest"] = choice_document(*design, *design->result.smallest);
    if (words.hours) doc["budget_hours"] = *words.hours;
    if (design->result.within_budget) {
      doc["within_budget"] = choice_document(*design, *design->result.within_budget);
    }
    std::vector<std::string> nulls;
    for (const auto& direction : design->null_space) nulls.push_back(direction.text);
    doc["null_space"] = nulls;
    std::cout << doc.json() << '\n';
  } else if (!words.quiet) {
    std::cout << study->machine().title() << '\n' << design_tests_text(*design, words.hours);
  }
  const auto& chosen = words.hours ? design->result.within_budget : design->result.smallest;
  return chosen && chosen->meets_limits ? kDone : kOutOfTolerance;
}

}  // namespace frustum::app

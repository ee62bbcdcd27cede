#include "app/view/design_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "app/view/shown_unit.hpp"
#include "app/view/text_table.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"

namespace frustum::app {
namespace {

using calibration::StepChoice;
using calibration::StepDesign;
using Json = nlohmann::ordered_json;

std::string deviation_text(const std::optional<double>& deviation, bool angular) {
  return deviation ? fmt::format("{:.3g}", shown(*deviation, angular)) : "-";
}

std::string sets_table(const StepDesign& design) {
  TextTable sets({"patterns", "number", "workpieces", "identified", "log det",
                  "sets of the size that identify all"});
  for (std::size_t i = 0; i < design.best_of_size.size(); ++i) {
    const StepChoice& c = design.best_of_size[i];
    sets.row({fmt::format("{}", fmt::join(c.patterns, " ")), fmt::format("{}", c.patterns.size()),
              fmt::format("{}", c.workpieces),
              fmt::format("{} of {}", c.choice.rank, design.free_unknowns),
              c.choice.log_det ? fmt::format("{:.2f}", *c.choice.log_det) : "-",
              fmt::format("{}", design.identifying_sets[i])});
  }
  return sets.text();
}

// Of the sets that identify everything; of the largest one when none does.
std::string deviations_table(const StepDesign& design) {
  std::vector<std::string> headings{"error", "unit"};
  std::vector<const StepChoice*> choices;
  for (const StepChoice& c : design.best_of_size) {
    if (!c.choice.identifies_all) continue;
    choices.push_back(&c);
    headings.push_back(counted(c.patterns.size(), "pattern"));
  }
  if (choices.empty() && !design.best_of_size.empty()) {
    choices.push_back(&design.best_of_size.back());
    headings.push_back(counted(choices.back()->patterns.size(), "pattern"));
  }
  TextTable table(headings);
  for (std::size_t k = 0; k < design.unknowns.size(); ++k) {
    const auto& unknown = design.unknowns[k];
    std::vector<std::string> cells{unknown.name, shown_unit(unknown.angular).name};
    for (const StepChoice* c : choices) {
      cells.push_back(deviation_text(c->choice.standard_deviations[k], unknown.angular));
    }
    table.row(std::move(cells));
  }
  return table.text();
}

Json choice_json(const StepDesign& design, const StepChoice& choice) {
  Json json;
  json["patterns"] = choice.patterns;
  json["workpieces"] = choice.workpieces;
  json["rank"] = choice.choice.rank;
  json["identifies_all"] = choice.choice.identifies_all;
  json["meets_limits"] = choice.choice.meets_limits;
  json["log_det"] = choice.choice.log_det ? Json(*choice.choice.log_det) : Json(nullptr);
  Json deviations = Json::object();
  for (std::size_t k = 0; k < design.unknowns.size(); ++k) {
    const auto& deviation = choice.choice.standard_deviations[k];
    deviations[design.unknowns[k].name] =
        deviation ? Json(shown(*deviation, design.unknowns[k].angular)) : Json(nullptr);
  }
  json["standard_deviations"] = std::move(deviations);
  return json;
}

}  // namespace

std::string design_text(const kinematics::Machine& machine, const StepDesign& design,
                        const std::vector<std::string>& exact, bool limited) {
  std::string out = fmt::format("{}: {}, {} to choose from\n", machine.title(),
                                counted(static_cast<std::size_t>(design.free_unknowns), "unknown"),
                                counted(design.patterns.size(), "step pattern"));
  for (const auto& u : design.unreachable) out += fmt::format("  out: {}\n", u.reason);
  if (!design.left_out.empty()) {
    out += fmt::format("  left out, since no step pattern separates them from the others: {}\n",
                       fmt::join(design.left_out, " "));
  }
  if (!exact.empty()) {
    out += fmt::format("  taken as exactly known (--known gives them an uncertainty): {}\n",
                       fmt::join(exact, " "));
  }
  out += "\nBest set of each size\n" + sets_table(design);
  const char* limits = limited ? " within the limits" : "";
  if (design.smallest) {
    out += fmt::format("\nSmallest set that identifies all{}: {}\n", limits,
                       fmt::join(design.smallest->patterns, " "));
  } else {
    out += fmt::format("\nNo set of these patterns identifies all errors{}.\n", limits);
    for (const auto& direction : design.null_space) out += "  " + direction.text + '\n';
  }
  return out + "\nExpected standard deviation of each error\n" + deviations_table(design);
}

std::string design_json(const kinematics::Machine& machine, const StepDesign& design,
                        const std::vector<std::string>& exact) {
  Json json;
  json["schema"] = "frustum/design/1";
  json["version"] = program_version();
  json["machine"] = machine.name();
  json["unknowns"] = Json::array();
  for (const auto& u : design.unknowns) {
    json["unknowns"].push_back({{"name", u.name}, {"unit", shown_unit(u.angular).name}});
  }
  json["left_out"] = design.left_out;
  json["taken_as_exact"] = exact;
  json["patterns"] = design.patterns;
  json["unreachable"] = Json::array();
  for (const auto& u : design.unreachable) {
    json["unreachable"].push_back({{"pattern", u.pattern}, {"reason", u.reason}});
  }
  json["best_of_size"] = Json::array();
  for (std::size_t i = 0; i < design.best_of_size.size(); ++i) {
    Json choice = choice_json(design, design.best_of_size[i]);
    choice["identifying_sets"] = design.identifying_sets[i];
    json["best_of_size"].push_back(std::move(choice));
  }
  json["smallest"] = design.smallest ? choice_json(design, *design.smallest) : Json(nullptr);
  json["smallest_identifying"] = design.smallest_identifying;
  json["null_space"] = Json::array();
  for (const auto& direction : design.null_space) json["null_space"].push_back(direction.text);
  return json.dump() + '\n';
}

}  // namespace frustum::app

#include "app/design_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/text_table.hpp"
#include "core/units.hpp"

namespace frustum::app {
namespace {

using calibration::DesignChoice;
using Json = nlohmann::ordered_json;

constexpr double kUradPerRad = 1e6;

double shown(double value, bool angular) { return value * (angular ? kUradPerRad : kUmPerMm); }

std::string names_of(const Design& design, const std::vector<std::size_t>& blocks) {
  std::string names;
  for (const std::size_t b : blocks) {
    names += (names.empty() ? "" : " ") + design.catalogue.patterns[b].name;
  }
  return names;
}

// Patterns on different workpieces need as many blanks.
std::size_t workpieces_of(const Design& design, const DesignChoice& choice) {
  std::set<int> numbers;
  for (const std::size_t b : choice.blocks) numbers.insert(design.catalogue.workpiece[b]);
  return numbers.size();
}

std::string deviation_text(const std::optional<double>& deviation, bool angular) {
  return deviation ? fmt::format("{:.3g}", shown(*deviation, angular)) : "-";
}

Json choice_json(const Design& design, const DesignChoice& choice) {
  Json json;
  json["patterns"] = Json::array();
  for (const std::size_t b : choice.blocks) {
    json["patterns"].push_back(design.catalogue.patterns[b].name);
  }
  json["workpieces"] = workpieces_of(design, choice);
  json["rank"] = choice.rank;
  json["identifies_all"] = choice.identifies_all;
  json["meets_limits"] = choice.meets_limits;
  json["log_det"] = choice.log_det ? Json(*choice.log_det) : Json(nullptr);
  Json deviations = Json::object();
  const auto& unknowns = design.catalogue.observations.unknowns;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const auto& deviation = choice.standard_deviations[k];
    deviations[unknowns[k].name] =
        deviation ? Json(shown(*deviation, unknowns[k].angular)) : Json(nullptr);
  }
  json["standard_deviations"] = std::move(deviations);
  return json;
}

}  // namespace

std::string design_text(const kinematics::Machine& machine, const Design& design) {
  const auto& unknowns = design.catalogue.observations.unknowns;
  std::string out =
      fmt::format("{}: {} unknowns, {} step patterns within travel\n", machine.title(),
                  design.result.unknowns, design.catalogue.patterns.size());
  for (const auto& u : design.catalogue.unreachable) out += fmt::format("  out: {}\n", u.reason);
  if (!design.left_out.empty()) {
    out += "  left out, since no step pattern tells them from the others:";
    for (const std::string& name : design.left_out) out += ' ' + name;
    out += '\n';
  }
  out += "\nBest set of each size\n";
  TextTable sets(
      {"patterns", "number", "workpieces", "told", "log det", "sets of the size that tell all"});
  for (std::size_t i = 0; i < design.result.best_of_size.size(); ++i) {
    const DesignChoice& c = design.result.best_of_size[i];
    sets.row({names_of(design, c.blocks), fmt::format("{}", c.blocks.size()),
              fmt::format("{}", workpieces_of(design, c)),
              fmt::format("{} of {}", c.rank, design.result.unknowns),
              c.log_det ? fmt::format("{:.2f}", *c.log_det) : "-",
              fmt::format("{}", design.result.identifying_sets[i])});
  }
  out += sets.text();
  if (design.result.smallest) {
    out += fmt::format("\nSmallest set that tells all{}: {}\n",
                       std::any_of(design.limits.begin(), design.limits.end(),
                                   [](const auto& l) { return l.has_value(); })
                           ? " within the limits"
                           : "",
                       names_of(design, design.result.smallest->blocks));
  } else {
    out += "\nNo set of these patterns tells all errors within the limits.\n";
    for (const auto& direction : design.null_space) out += direction.text + '\n';
  }
  out += "\nExpected standard deviation of each error\n";
  std::vector<std::string> headings{"error", "unit"};
  std::vector<const DesignChoice*> choices;
  for (const DesignChoice& c : design.result.best_of_size) {
    if (!c.identifies_all) continue;
    choices.push_back(&c);
    headings.push_back(fmt::format("{} patterns", c.blocks.size()));
  }
  if (choices.empty() && !design.result.best_of_size.empty()) {
    choices.push_back(&design.result.best_of_size.back());
    headings.emplace_back("all patterns");
  }
  TextTable deviations(headings);
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    std::vector<std::string> cells{unknowns[k].name, unknowns[k].angular ? "urad" : "um"};
    for (const DesignChoice* c : choices) {
      cells.push_back(deviation_text(c->standard_deviations[k], unknowns[k].angular));
    }
    deviations.row(std::move(cells));
  }
  return out + deviations.text();
}

std::string design_json(const kinematics::Machine& machine, const Design& design) {
  Json json;
  json["machine"] = machine.name();
  json["unknowns"] = Json::array();
  for (const auto& u : design.catalogue.observations.unknowns) {
    json["unknowns"].push_back({{"name", u.name}, {"unit", u.angular ? "urad" : "um"}});
  }
  json["left_out"] = design.left_out;
  json["unreachable"] = Json::array();
  for (const auto& u : design.catalogue.unreachable) {
    json["unreachable"].push_back({{"pattern", u.pattern}, {"reason", u.reason}});
  }
  json["best_of_size"] = Json::array();
  for (const DesignChoice& c : design.result.best_of_size) {
    json["best_of_size"].push_back(choice_json(design, c));
  }
  json["smallest"] =
      design.result.smallest ? choice_json(design, *design.result.smallest) : Json(nullptr);
  json["null_space"] = Json::array();
  for (const auto& direction : design.null_space) json["null_space"].push_back(direction.text);
  json["smallest_identifying"] = Json::array();
  for (const auto& set : design.result.smallest_identifying) {
    Json names = Json::array();
    for (const std::size_t b : set) names.push_back(design.catalogue.patterns[b].name);
    json["smallest_identifying"].push_back(std::move(names));
  }
  return json.dump() + '\n';
}

}  // namespace frustum::app

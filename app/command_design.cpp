// frustum design: which step patterns to cut so that a machine's errors can be told.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/console.hpp"
#include "app/design_view.hpp"
#include "app/identification.hpp"
#include "app/machine_files.hpp"
#include "core/spelling.hpp"

namespace frustum::app {
namespace {

using calibration::DesignCriterion;

struct Options {
  std::string machine{};
  std::vector<std::string> patterns{}, required{}, unknowns{};
  std::vector<std::string> known{}, limits{};
  std::string criterion = "d";
  std::string e0 = "0.5 um";
  double l_per_um = 600.0;
  std::string center{};
  std::optional<double> tool_diameter{}, tool_length{};
  double raise = 0.0;
  bool json = false;
};

// "beta_CA=5urad": an error's name and an amount that suits it.
struct NamedAmount {
  std::string name{};
  double amount = 0.0;
};
Result<NamedAmount> named_amount(const kinematics::Machine& machine, const std::string& text,
                                 const char* option) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    return error(fmt::format("{} {}: expected NAME=VALUE", option, text),
                 "for example gamma_YX=5urad");
  }
  const auto parameter = trials::Parameter::named(machine, text.substr(0, equals));
  if (!parameter) return parameter.error();
  const std::string amount = text.substr(equals + 1);
  double value = 0.0;
  if (parameter->angular) {
    const auto angle = parse_angle(amount);
    if (!angle) return angle.error();
    value = angle->value;
  } else {
    const auto length = parse_length(amount);
    if (!length) return length.error();
    value = length->value;
  }
  if (value < 0.0) {
    return error(fmt::format("{} {}: must not be negative", option, text),
                 "it is a standard uncertainty");
  }
  return NamedAmount{parameter->name, value};
}

// All machine errors that its file names, without the linear axes' squareness unless it is asked for.
std::vector<std::string> default_unknowns(const kinematics::Machine& machine) {
  std::vector<std::string> names;
  const auto of_rotary_axis = [&](const kinematics::ErrorName& e) {
    return e.location && kinematics::is_rotary(e.axis);
  };
  for (const auto& [alias, meaning] : machine.aliases()) {
    if (of_rotary_axis(meaning.error)) names.push_back(alias);
  }
  if (!names.empty()) return names;
  for (const auto& e : machine.error_names()) {
    if (of_rotary_axis(e)) names.push_back(e.text());
  }
  return names;
}

// Keeps the unknowns that all patterns together tell one after the other.
void leave_out_dependent(Design& design) {
  calibration::Observations& all = design.catalogue.observations;
  const auto kept = calibration::independent_unknowns(all);
  if (!kept) return;
  const auto is_kept = [&](std::size_t k) {
    return std::find(kept->begin(), kept->end(), static_cast<Eigen::Index>(k)) != kept->end() ||
           all.unknowns[k].is_fixed();
  };
  std::vector<calibration::Unknown> unknowns;
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < all.unknowns.size(); ++k) {
    if (is_kept(k)) {
      unknowns.push_back(all.unknowns[k]);
      columns.push_back(static_cast<Eigen::Index>(k));
    } else {
      design.left_out.push_back(all.unknowns[k].name);
    }
  }
  all.gain = Eigen::MatrixXd(all.gain(Eigen::all, columns));
  all.unknowns = std::move(unknowns);
}

Result<Design> design_of(const Options& o, const kinematics::Machine& machine) {
  Diagnostics problems;
  const auto keep = [&](const auto& result) {
    if (!result) problems.insert(problems.end(), result.error().begin(), result.error().end());
    return result.has_value();
  };
  std::vector<std::string> names = o.unknowns.empty() ? default_unknowns(machine) : o.unknowns;
  std::vector<KnownError> known;
  for (const std::string& text : o.known) {
    const auto k = named_amount(machine, text, "--known");
    if (!keep(k)) continue;
    known.push_back({k->name, 0.0, k->amount});
    if (std::find(names.begin(), names.end(), k->name) == names.end()) names.push_back(k->name);
  }
  auto all = unknown_causes(machine, names, known);
  keep(all);
  metrology::CmmModel cmm;
  const auto e0 = parse_length(o.e0);
  if (keep(e0)) cmm.e0_mm = e0->value;
  if (e0 && !(cmm.e0_mm > 0.0)) {
    problems.push_back(error("--e0 must be above 0", "for example --e0 \"0.5 um\""));
  }
  cmm.length_per_error = o.l_per_um;
  calibration::CatalogueSetup setup;
  setup.raise = o.raise;
  if (!o.center.empty()) {
    const auto center = numbers_of(o.center, 2, "--center");
    if (keep(center)) setup.centre = {(*center)[0], (*center)[1]};
  }
  if (o.tool_diameter) setup.test.tool_diameter = {*o.tool_diameter};
  if (o.tool_length) setup.test.tool_length = {*o.tool_length};
  if (!problems.empty()) return problems;
  all->unknowns.push_back({.name = std::string(trials::kToolRadius)});
  all->causes.push_back({{std::string(trials::kToolRadius), false, std::nullopt}, std::nullopt});
  auto catalogue = calibration::step_catalogue(machine, all->unknowns, all->causes, cmm, setup);
  if (!catalogue) return std::move(catalogue).error();
  Design design{std::move(*catalogue), {}, {}, {}};
  // A list that nobody gave may hold what no pattern can tell apart.
  if (o.unknowns.empty()) leave_out_dependent(design);
  return design;
}

std::vector<std::string> names_of(const calibration::StepCatalogue& catalogue) {
  std::vector<std::string> names;
  for (const auto& pattern : catalogue.patterns) names.push_back(pattern.name);
  return names;
}

// Keeps the patterns asked for; a name that cannot be cut is an error that says why.
std::optional<Diagnostics> choose_patterns(Design& design, const Options& o,
                                           calibration::DesignOptions& options) {
  const auto index_of = [&](const std::string& name) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < design.catalogue.patterns.size(); ++i) {
      if (design.catalogue.patterns[i].name == name) return i;
    }
    return std::nullopt;
  };
  Diagnostics problems;
  const auto unknown_name = [&](const std::string& name) {
    for (const auto& u : design.catalogue.unreachable) {
      if (u.pattern == name) {
        problems.push_back(error(u.reason, "leave the pattern out"));
        return;
      }
    }
    problems.push_back(error(fmt::format("there is no pattern '{}' to choose from", name),
                             suggestion(name, names_of(design.catalogue))));
  };
  for (const std::string& name : o.patterns) {
    if (!index_of(name)) unknown_name(name);
  }
  for (const std::string& name : o.required) {
    const bool left_out = !o.patterns.empty() &&
                          std::find(o.patterns.begin(), o.patterns.end(), name) == o.patterns.end();
    if (!index_of(name) || left_out) unknown_name(name);
  }
  if (!problems.empty()) return problems;
  if (!o.patterns.empty()) {
    std::vector<calibration::DesignBlock> chosen;
    std::vector<int> workpieces;
    for (std::size_t i = 0; i < design.catalogue.patterns.size(); ++i) {
      const std::string& name = design.catalogue.patterns[i].name;
      if (std::find(o.patterns.begin(), o.patterns.end(), name) == o.patterns.end()) continue;
      chosen.push_back(design.catalogue.patterns[i]);
      workpieces.push_back(design.catalogue.workpiece[i]);
    }
    design.catalogue.patterns = std::move(chosen);
    design.catalogue.workpiece = std::move(workpieces);
  }
  for (const std::string& name : o.required) options.required.push_back(*index_of(name));
  return std::nullopt;
}

// Of all patterns to choose from together.
std::vector<calibration::NullDirection> null_space_of(const Design& design) {
  std::vector<Eigen::Index> rows;
  for (const auto& pattern : design.catalogue.patterns) {
    rows.insert(rows.end(), pattern.rows.begin(), pattern.rows.end());
  }
  const auto told = calibration::observability(design.catalogue.observations.selected(rows));
  return told ? told->null_space : std::vector<calibration::NullDirection>{};
}

int show_design(const Options& o) {
  const auto machine = kinematics::Machine::load(find_machine(o.machine, "."));
  if (!machine) return refuse(machine.error());
  auto design = design_of(o, *machine);
  if (!design) return refuse(design.error());
  calibration::DesignOptions options;
  options.criterion = o.criterion == "d"   ? DesignCriterion::d_optimal
                      : o.criterion == "a" ? DesignCriterion::a_optimal
                                           : DesignCriterion::worst_unknown;
  if (const auto problems = choose_patterns(*design, o, options)) return refuse(*problems);
  const auto& unknowns = design->catalogue.observations.unknowns;
  options.limits.resize(unknowns.size());
  for (const std::string& text : o.limits) {
    const auto limit = named_amount(*machine, text, "--limit");
    if (!limit) return refuse(limit.error());
    const auto at = std::find_if(unknowns.begin(), unknowns.end(),
                                 [&](const auto& u) { return u.name == limit->name; });
    if (at == unknowns.end()) {
      return refuse(fmt::format("--limit {}: not one of the unknowns", text),
                    "add it with --unknown");
    }
    options.limits[static_cast<std::size_t>(at - unknowns.begin())] = limit->amount;
  }
  auto result =
      calibration::design(design->catalogue.observations, design->catalogue.patterns, options);
  if (!result) return refuse(result.error());
  design->result = *std::move(result);
  design->null_space = null_space_of(*design);
  design->limits = options.limits;
  std::cout << (o.json ? design_json(*machine, *design) : design_text(*machine, *design));
  return design->result.smallest ? kDone : kOutOfTolerance;
}

}  // namespace

void add_design(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "design", "Which step patterns to cut so that a machine's errors can be told apart");
  command->add_option("--machine", o->machine, "Machine file, or the name of a shipped machine")
      ->required();
  command
      ->add_option("--patterns", o->patterns, "Choose from these only (default: all within travel)")
      ->delimiter(',');
  command->add_option("--require", o->required, "In every set: these are cut anyway")
      ->delimiter(',');
  command
      ->add_option("--unknown", o->unknowns,
                   "Machine errors to be found (default: location errors of the rotary axes)")
      ->delimiter(',');
  command->add_option("--known", o->known,
                      "NAME=standard uncertainty of an error known from elsewhere, for example "
                      "gamma_YX=5urad; 0 is exact");
  command->add_option("--limit", o->limits,
                      "NAME=largest standard deviation wanted, for example dy_CA=1um");
  command
      ->add_option("--criterion", o->criterion,
                   "d: smallest joint volume (default), a: smallest sum of variances, worst: "
                   "smallest largest deviation")
      ->check(CLI::IsMember({"d", "a", "worst"}));
  command->add_option("--e0", o->e0, "CMM: E = e0 + L/k as a length (\"0.5 um\")");
  command->add_option("--l-per-um", o->l_per_um, "CMM: k, mm of length per um of error (600)")
      ->check(CLI::PositiveNumber);
  command->add_option("--center", o->center, "x,y of both workpieces' centres, mm");
  command->add_option("--raise", o->raise, "Added to all heights above the tilt axis, mm (0)");
  command->add_option("--tool-diameter", o->tool_diameter, "mm (20)");
  command->add_option("--tool-length", o->tool_length, "mm (150)");
  command->add_flag("--json", o->json, "One JSON document on stdout");
  command->footer(
      "Exit code 1: no set of these patterns tells all errors within the limits.\n"
      "Example: frustum design --machine zx-yac --known gamma_YX=5urad --known alpha_ZY=5urad "
      "--known beta_ZX=5urad");
  command->callback([o, &exit_code] { exit_code = show_design(*o); });
}

}  // namespace frustum::app

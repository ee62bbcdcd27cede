// frustum design: which step patterns or test pieces to cut, and which motion tests to run, so that
// a machine's errors can be identified.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/identification.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/named_amount.hpp"
#include "app/job/number_list.hpp"
#include "app/motion/design_tests.hpp"
#include "app/view/console.hpp"
#include "app/view/design_view.hpp"

namespace frustum::app {
namespace {

using calibration::DesignCriterion;

struct DesignOptions : AnswerOptions {
  std::string machine{};
  std::vector<std::string> patterns{}, required{}, unknowns{};
  std::vector<std::string> known{}, limits{};
  std::string study{};
  std::optional<double> hours{};
  std::string criterion = "d";
  std::string e0 = "0.5 um";
  double l_per_um = 600.0;
  std::string center{};
  std::optional<double> tool_diameter{}, tool_length{};
  double raise = 0.0;
};

DesignCriterion criterion_of(const DesignOptions& o) {
  return o.criterion == "d"   ? DesignCriterion::d_optimal
         : o.criterion == "a" ? DesignCriterion::a_optimal
                              : DesignCriterion::worst_unknown;
}

// Location errors of the rotary axes, under the machine's own symbols when it has any.
std::vector<std::string> rotary_errors(const kinematics::Machine& machine) {
  std::vector<std::string> names;
  const auto wanted = [](const kinematics::ErrorName& e) {
    return e.location && kinematics::is_rotary(e.axis);
  };
  for (const auto& [alias, meaning] : machine.aliases()) {
    if (wanted(meaning.error)) names.push_back(alias);
  }
  if (!names.empty()) return names;
  for (const auto& e : machine.error_names()) {
    if (wanted(e)) names.push_back(e.text());
  }
  return names;
}

// Reads what the command line says; every mistake is kept.
class Request {
 public:
  Request(const DesignOptions& options, const kinematics::Machine& machine)
      : options_(options), machine_(machine) {}

  [[nodiscard]] Result<UnknownCauses> unknowns() {
    std::vector<std::string> names =
        options_.unknowns.empty() ? rotary_errors(machine_) : options_.unknowns;
    std::vector<KnownError> known;
    for (const std::string& text : options_.known) {
      const auto k = keep(named_amount(machine_, text, "--known"));
      if (!k) continue;
      const bool again = std::any_of(known.begin(), known.end(), [&](const KnownError& other) {
        return other.name == k->name;
      });
      if (again) {
        problems_.push_back(error("given-twice"_id, fmt::format("--known {}: given twice", k->name),
                                  "one value for each error"));
      }
      known.push_back({k->name, 0.0, k->amount});
      if (std::find(names.begin(), names.end(), k->name) == names.end()) names.push_back(k->name);
    }
    const std::string radius(trials::kToolRadius);
    if (std::find(names.begin(), names.end(), radius) == names.end()) names.push_back(radius);
    auto all = unknown_causes(machine_, names, known);
    if (!all) problems_.insert(problems_.end(), all.error().begin(), all.error().end());
    if (!problems_.empty()) return problems_;
    return all;
  }

  [[nodiscard]] metrology::CmmModel cmm() {
    metrology::CmmModel cmm;
    if (const auto e0 = keep(parse_length(options_.e0))) cmm.e0_mm = e0->value;
    if (!(cmm.e0_mm > 0.0)) {
      problems_.push_back(error("out-of-range"_id,
                                fmt::format("--e0 {}: must be a length above 0", options_.e0),
                                "for example --e0 \"0.5 um\""));
    }
    cmm.length_per_error = options_.l_per_um;
    return cmm;
  }

  [[nodiscard]] calibration::CatalogueSetup setup() {
    calibration::CatalogueSetup setup;
    setup.raise = options_.raise;
    if (!options_.center.empty()) {
      if (const auto center = keep(numbers_of(options_.center, 2, "--center"))) {
        setup.centre = {(*center)[0], (*center)[1]};
      }
    }
    if (options_.tool_diameter) setup.test.tool_diameter = {*options_.tool_diameter};
    if (options_.tool_length) setup.test.tool_length = {*options_.tool_length};
    return setup;
  }

  [[nodiscard]] calibration::StepDesignOptions choice() {
    calibration::StepDesignOptions choice;
    choice.criterion = criterion_of(options_);
    choice.among = options_.patterns;
    choice.required = options_.required;
    for (const std::string& text : options_.limits) {
      if (const auto limit = keep(named_amount(machine_, text, "--limit"))) {
        choice.limits[limit->name] = limit->amount;
      }
    }
    // A list that nobody gave may hold what no pattern can separate.
    choice.leave_out_dependent = options_.unknowns.empty();
    return choice;
  }

  [[nodiscard]] const Diagnostics& problems() const { return problems_; }

 private:
  template <typename T>
  std::optional<T> keep(Result<T> result) {
    if (result) return *std::move(result);
    problems_.insert(problems_.end(), result.error().begin(), result.error().end());
    return std::nullopt;
  }

  const DesignOptions& options_;
  const kinematics::Machine& machine_;
  Diagnostics problems_;
};

// Limits of what is not among the unknowns.
Diagnostics unused_limits(const calibration::StepDesignOptions& choice,
                          const UnknownCauses& unknowns) {
  Diagnostics problems;
  for (const auto& [name, limit] : choice.limits) {
    const bool is_unknown =
        std::any_of(unknowns.unknowns.begin(), unknowns.unknowns.end(),
                    [&, wanted = name](const auto& u) { return u.name == wanted; });
    if (is_unknown) continue;
    problems.push_back(error("unknown-error"_id,
                             fmt::format("--limit {}: not one of the unknowns", name),
                             "add it with --unknown"));
  }
  return problems;
}

// Constant errors of the machine that the design takes for known exactly: under the machine's own
// symbols when it has any.
std::vector<std::string> taken_as_zero(const kinematics::Machine& machine,
                                       const calibration::StepDesign& design) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    const bool is_unknown =
        std::any_of(design.unknowns.begin(), design.unknowns.end(),
                    [&](const auto& u) { return u.name == name && !u.is_fixed(); });
    const bool is_left_out =
        std::find(design.left_out.begin(), design.left_out.end(), name) != design.left_out.end();
    if (!is_unknown && !is_left_out) names.push_back(name);
  };
  for (const auto& [alias, meaning] : machine.aliases()) {
    if (meaning.error.location) add(alias);
  }
  if (!machine.aliases().empty()) return names;
  for (const auto& e : machine.error_names()) {
    if (e.location) add(e.text());
  }
  return names;
}

// What only a choice among step patterns takes; a study says these itself.
Diagnostics without_study(const DesignOptions& o) {
  const DesignOptions usual;
  Diagnostics unused;
  const auto note = [&](const char* option, bool given) {
    if (!given) return;
    unused.push_back(error("conflicting-options"_id,
                           fmt::format("{} does not go with --study", option),
                           "leave it out: the study says which machine, unknowns and tests"));
  };
  note("MACHINE", !o.machine.empty());
  note("--patterns", !o.patterns.empty());
  note("--unknown", !o.unknowns.empty());
  note("--known", !o.known.empty());
  note("--e0", o.e0 != usual.e0);
  note("--l-per-um", o.l_per_um != usual.l_per_um);
  note("--center", !o.center.empty());
  note("--raise", o.raise != usual.raise);
  note("--tool-diameter", o.tool_diameter.has_value());
  note("--tool-length", o.tool_length.has_value());
  return unused;
}

int show_design(const DesignOptions& o) {
  if (!o.study.empty()) {
    if (const auto unused = without_study(o); !unused.empty()) return refuse(unused, o);
    const TestDesignWords words{o, o.study, o.required, o.limits, o.hours, criterion_of(o)};
    return show_test_design(words);
  }
  if (o.machine.empty()) {
    return refuse(
        {error("missing-option"_id, "neither a machine nor a study is given",
               "frustum design MACHINE for step patterns, --study FILE for test pieces and motion "
               "tests")},
        o);
  }
  if (o.hours) {
    return refuse({error("conflicting-options"_id, "--hours goes with --study",
                         "a study says which pieces and tests there are, and what they take")},
                  o);
  }
  const auto machine = load_machine(o.machine, ".");
  if (!machine) return refuse(machine.error(), o);
  Request request(o, *machine);
  const metrology::CmmModel cmm = request.cmm();
  const calibration::CatalogueSetup setup = request.setup();
  const calibration::StepDesignOptions choice = request.choice();
  const auto all = request.unknowns();
  if (!all) return refuse(all.error(), o);
  if (!request.problems().empty()) return refuse(request.problems(), o);
  if (const Diagnostics unused = unused_limits(choice, *all); !unused.empty()) {
    return refuse(unused, o);
  }
  const auto design = with_progress(o, "choose patterns", [&](report::Progress&) {
    return calibration::step_design(*machine, all->unknowns, all->causes, cmm, setup, choice);
  });
  if (!design) return refuse(design.error(), o);
  const bool limited = !choice.limits.empty();
  if (o.json) {
    std::cout << design_json(*machine, *design, taken_as_zero(*machine, *design));
  } else if (!o.quiet) {
    std::cout << design_text(*machine, *design, taken_as_zero(*machine, *design), limited);
  }
  return design->smallest ? kDone : kOutOfTolerance;
}

}  // namespace

void add_design(Command& program) {
  auto o = std::make_shared<DesignOptions>();
  Command command =
      program.command("design",
                      "Which step patterns or test pieces to cut, and motion tests to "
                      "run, so that a machine's errors can be separated");
  command.option("machine,--machine", o->machine, "Machine file, or the name of a shipped machine");
  command.option(
      "--study", o->study,
      "Choose from the test pieces and motion tests of a study instead of step patterns: [[part]] "
      "with name and job, [[motion]] with test and noise; unknowns and what is known are the "
      "study's");
  command
      .option("--hours", o->hours,
              "With --study: the best set that takes no more hours at machine and CMM together")
      .holds(positive_number());
  command.option("--patterns", o->patterns, "Choose from these only (default: all within travel)")
      .separated_by(',');
  command.option("--require", o->required, "In every set: these are cut anyway").separated_by(',');
  command
      .option("--unknown", o->unknowns,
              "Machine errors to be found (default: location errors of the rotary axes); "
              "the tool radius error always is one")
      .separated_by(',');
  command.option("--known", o->known,
                 "NAME=standard uncertainty of an error known from elsewhere, for example "
                 "gamma_YX=5urad; 0 is exact");
  command.option("--limit", o->limits,
                 "NAME=largest standard deviation wanted, for example dy_CA=1um");
  command
      .option("--criterion", o->criterion,
              "d: smallest joint volume (default), a: smallest sum of variances, worst: "
              "smallest largest deviation")
      .one_of({"d", "a", "worst"});
  command.option("--e0", o->e0, "CMM: E = e0 + L/k as a length (\"0.5 um\")");
  command.option("--l-per-um", o->l_per_um, "CMM: k, mm of length per um of error (600)")
      .holds(positive_number());
  command.option("--center", o->center, "x,y of both workpieces' centres, mm");
  command.option("--raise", o->raise, "Added to all heights above the tilt axis, mm (0)");
  command.option("--tool-diameter", o->tool_diameter, "mm (20)");
  command.option("--tool-length", o->tool_length, "mm (150)");
  add_answer_options(command, *o);
  command.footer(
      "Exit code 1: no set of these patterns identifies all errors within the limits.\n"
      "Example: frustum design --machine zx-yac --known gamma_YX=5urad --known alpha_ZY=5urad "
      "--known beta_ZX=5urad");
  command.computes([o] { return show_design(*o); });
}

}  // namespace frustum::app

// frustum check: holds NC programs against what goes wrong at the machine.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/program_checker.hpp"
#include "app/job/program_files.hpp"
#include "app/view/console.hpp"
#include "core/printable_text.hpp"
#include "core/whole_file.hpp"
#include "lint/json_findings.hpp"
#include "lint/sarif_findings.hpp"
#include "lint/text_findings.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutput = "-";

struct CheckCommand : AnswerOptions {
  std::vector<std::string> paths{};
  CheckSettings settings{};
  std::string sarif{};
  bool no_settings = false;
  bool write_baseline = false;
  bool list = false;
};

int list_checks() {
  for (const lint::CheckInfo& info : lint::all_checks()) {
    const char* needs = info.needs == lint::Needs::machine ? ", with a machine"
                        : info.needs == lint::Needs::job   ? ", with a job"
                                                           : "";
    std::cout << info.id << " (" << to_string(info.severity) << needs << "): " << info.title
              << '\n';
  }
  return kDone;
}

// The document of one program is as it always was; several have one around them.
bool is_one_file(const CheckCommand& options) {
  std::error_code unknown;
  return options.paths.empty() ||
         (options.paths.size() == 1 && !fs::is_directory(options.paths.front(), unknown));
}

void print_findings(const CheckCommand& options, const std::vector<lint::CheckedFile>& checked,
                    const Diagnostics& troubles) {
  if (options.json) {
    const bool one = is_one_file(options) && !checked.empty();
    std::cout << (one ? lint::json_of(checked.front(), troubles)
                      : lint::json_of(checked, troubles));
    return;
  }
  for (const lint::CheckedFile& each : checked) std::cout << lint::text_of(each);
  if (!checked.empty() || !is_one_file(options)) std::cout << lint::summary_of(checked);
}

// What would be written over one another, or over what is read.
Diagnostics overwritten(const CheckCommand& options, ProgramChecker& checker,
                        const std::vector<ProgramToCheck>& programs) {
  Diagnostics wrong;
  const auto refuse_it = [&wrong](const std::string& option, const std::string& file) {
    wrong.push_back(error("output-overwrites-input"_id,
                          fmt::format("{} {} would overwrite what is read", option, file),
                          "choose another file"));
  };
  const bool sarif = !options.sarif.empty() && options.sarif != kOutput;
  if (sarif && checker.reads(options.sarif, programs)) refuse_it("--sarif", options.sarif);
  for (const std::string& file : checker.baselines_of(programs)) {
    if (options.write_baseline && checker.reads(file, programs)) refuse_it("--baseline", file);
    if (sarif && is_same_file(options.sarif, file)) refuse_it("--sarif", options.sarif);
  }
  return wrong;
}

int check_files(const CheckCommand& options) {
  if (options.list) return list_checks();
  const bool sarif_alone = options.sarif == kOutput;
  if (sarif_alone && options.json) {
    return refuse(error("option-conflict"_id, "--json and --sarif - both take the standard output",
                        "name a file for one of them"),
                  options);
  }
  if (!options.sarif.empty() && !sarif_alone) {
    if (const auto fault = unwritable(options.sarif)) return refuse(*fault, options);
  }
  ProgramChecker checker(options.settings, options.no_settings, [&](const std::string& note) {
    if (!options.quiet) std::cerr << "note: " << printable(note) << '\n';
  });
  const auto programs = checker.programs_of(options.paths);
  if (options.paths.empty() && programs.empty() && checker.troubles().empty()) {
    return refuse(error("missing-option"_id, "no program", "name the files and folders to check"),
                  options);
  }
  if (const auto wrong = overwritten(options, checker, programs); !wrong.empty()) {
    return refuse(wrong, options);
  }
  std::vector<lint::CheckedFile> checked = checker.check(programs);
  if (options.write_baseline) {
    for (const std::string& file : checker.write_baselines(checked)) {
      if (!options.quiet) std::cerr << "note: baseline " << printable(file) << " written\n";
    }
  } else {
    checker.apply_baselines(checked);
  }
  for (lint::CheckedFile& each : checked) {
    each.passed = options.write_baseline || checker.passes(each);
    each.report.cut_short();
  }
  const bool passed = std::ranges::all_of(checked, [](const auto& each) { return each.passed; });
  if (!options.sarif.empty()) {
    const std::string sarif = lint::sarif_of(checked, {.folder = fs::current_path(),
                                                       .version = FRUSTUM_VERSION,
                                                       .documents = documents_uri(),
                                                       .troubles = checker.troubles()});
    if (sarif_alone) {
      std::cout << sarif;
    } else if (const auto written = write_whole_file(options.sarif, sarif); !written) {
      return refuse(written.error(), options);
    }
  }
  if (!sarif_alone) print_findings(options, checked, checker.troubles());
  if (!checker.troubles().empty()) return refuse(checker.troubles());
  return passed ? kDone : kOutOfTolerance;
}

}  // namespace

void add_check(Command& program) {
  auto o = std::make_shared<CheckCommand>();
  Command command = program.command(
      "check", "Find what will go wrong with NC programs, without cutting anything");
  CheckSettings& settings = o->settings;
  command.option("file", o->paths,
                 "NC programs, folders with programs, - for the standard input (default: the "
                 "program of --job)");
  add_setup_options(command, settings.setup_words);
  add_control_options(command, settings.setup_words);
  command
      .option("--dialect", settings.dialect,
              "fanuc (or iso), linuxcnc, sinumerik, heidenhain or cldata (default: recognised)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  command.option(
      "--tools", settings.tools,
      "LinuxCNC tool table: lengths and diameters; G43, M6 and M61 take its tools alone");
  command.flag("--inch-machine", settings.inch_machine,
               "The tool table and parameters such as #5221 count in inches (default: mm)");
  command
      .option("--search,--search-path", settings.search,
              "Folder with subprograms, repeated (that of the program comes first)")
      .existing_folder();
  command.flag("--block-delete", settings.block_delete, "Leave out blocks that begin with /");
  command.option("--disable", settings.disabled, "Leave out a check, by its id; repeated");
  command
      .option("--fail-on", settings.fail_on,
              "What makes the exit code 1: error (default), warning or note, and what is above")
      .one_of({"error", "warning", "note"});
  command
      .option("--most-repeats", settings.most_repeats,
              "Blocks that loops and repeats run again before the check ends (default 1000000)")
      .within(std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max());
  command.option("--baseline", settings.baseline,
                 "File with findings that are known and do not count");
  command.flag("--write-baseline", o->write_baseline,
               "Write the findings to the baseline instead of reporting them as new");
  command.flag("--no-config", o->no_settings, "Do not look for .frustum.toml");
  add_answer_options(command, *o);
  command.option("--sarif", o->sarif,
                 "Write the findings as SARIF 2.1.0 too; - for the standard output instead");
  command.flag("--list", o->list, "List the checks with their ids and end");
  command.footer(
      "Example: frustum check parts/ --machine iwf-bc --fail-on warning\n"
      "Exit code 0: clean; 1: a finding at or above the severity of --fail-on; 2: a file, the "
      "settings or the output are in trouble. docs/check.md has all checks.");
  command.computes([o] { return check_files(*o); });
}

}  // namespace frustum::app

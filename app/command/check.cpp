// frustum check: holds an NC program against what goes wrong at the machine.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/job/nc_file.hpp"
#include "app/view/console.hpp"
#include "core/spelling.hpp"
#include "core/whole_file.hpp"
#include "lint/json_findings.hpp"
#include "lint/program_check.hpp"
#include "lint/sarif_findings.hpp"
#include "lint/text_findings.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  std::string file{};
  SetupWords setup_words{};
  std::string dialect{};  // recognised when not given
  std::vector<std::string> search{};
  std::vector<std::string> disabled{};
  std::string fail_on = "error";
  std::string sarif{};
  std::string tools{};  // a tool table
  bool inch_machine = false;
  bool block_delete = false;
  bool json = false;
  bool quiet = false;
  bool list = false;
};

int list_checks() {
  for (const lint::CheckInfo& info : lint::all_checks()) {
    std::cout << info.id << " (" << to_string(info.severity)
              << (info.needs_machine ? ", with a machine" : "") << "): " << info.title << '\n';
  }
  return kDone;
}

Result<std::set<lint::Check>> disabled_checks(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const lint::CheckInfo& info : lint::all_checks()) known.emplace_back(info.id);
  std::set<lint::Check> disabled;
  Diagnostics unknown;
  for (const std::string& name : names) {
    if (const auto check = lint::check_named(name)) {
      disabled.insert(*check);
      continue;
    }
    unknown.push_back(error("unknown-check"_id, "--disable " + name + ": there is no such check",
                            suggestion(name, known)));
  }
  if (!unknown.empty()) return unknown;
  return disabled;
}

bool passes(const lint::CheckReport& report, const std::string& fail_on) {
  const bool warnings_fail = fail_on == "warning";
  return report.count(Severity::error) == 0 &&
         !(warnings_fail && report.count(Severity::warning) > 0);
}

int check_file(const CheckOptions& options) {
  if (options.list) return list_checks();
  if (options.file.empty())
    return refuse("missing-option"_id, "no program", "name the file to check");
  auto disabled = disabled_checks(options.disabled);
  if (!disabled) return refuse(disabled.error());
  const auto nc = open_nc(options.file, options.dialect);
  if (!nc) return refuse(nc.error());

  lint::CheckOptions check;
  check.disabled = *std::move(disabled);
  check.run = options_for(options.file);
  check.run.search_path.insert(check.run.search_path.end(), options.search.begin(),
                               options.search.end());
  check.run.block_delete = options.block_delete;
  const auto known = known_setup_of(options.setup_words);
  if (!known) return refuse(known.error());
  if (known->machine) check.machine = &*known->machine;
  check.setup = known->setup;
  check.run.tools = known->tools;
  if (options.inch_machine) check.run.machine_unit = parser::LengthUnit::inch;
  if (!options.tools.empty()) {
    auto tools = parser::read_tool_table(options.tools, check.run.machine_unit);
    if (!tools) return refuse(tools.error());
    check.run.tools = *std::move(tools);
  }
  if (!options.quiet) {
    if (!nc->reason.empty()) {
      std::cerr << "note: read as " << name_of(nc->program.dialect) << " (" << nc->reason << ")\n";
    }
    if (!known->machine) std::cerr << "note: no --machine: travels and axes are not checked\n";
  }

  const lint::CheckReport report = lint::check_program(nc->program, check);
  const lint::SourceLines lines = lint::source_lines(nc->program, report.findings);
  const bool passed = passes(report, options.fail_on);
  if (!options.sarif.empty()) {
    const auto written = write_whole_file(
        options.sarif, lint::sarif_of(report, lines, {fs::current_path(), FRUSTUM_VERSION}));
    if (!written) return refuse(written.error());
  }
  if (options.json) {
    std::cout << lint::json_of(report,
                               {options.file, name_of(nc->program.dialect),
                                known->machine ? known->machine->name() : std::string(), passed});
  } else {
    std::cout << lint::text_of(report, lines);
  }
  return passed ? kDone : kOutOfTolerance;
}

}  // namespace

void add_check(Command& program) {
  auto o = std::make_shared<CheckOptions>();
  Command command = program.command(
      "check", "Find what will go wrong with an NC program, without cutting anything");
  command.option("file", o->file, "NC program");
  add_setup_options(command, o->setup_words);
  command
      .option("--dialect", o->dialect,
              "fanuc (or iso), linuxcnc, sinumerik, heidenhain or cldata (default: recognised)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  command.option(
      "--tools", o->tools,
      "LinuxCNC tool table: lengths and diameters; G43, M6 and M61 take its tools alone");
  command.flag("--inch-machine", o->inch_machine,
               "The tool table and parameters such as #5221 count in inches (default: mm)");
  command
      .option("--search,--search-path", o->search,
              "Folder with subprograms, repeated (that of the program comes first)")
      .existing_folder();
  command.flag("--block-delete", o->block_delete, "Leave out blocks that begin with /");
  command.option("--disable", o->disabled, "Leave out a check, by its id; repeated");
  command.option("--fail-on", o->fail_on, "What makes the exit code 1: error (default), warning")
      .one_of({"error", "warning"});
  command.flag("--json", o->json, "Print the findings as one JSON document");
  command.option("--sarif", o->sarif, "Write the findings as SARIF 2.1.0 too");
  command.flag("--list", o->list, "List the checks with their ids and end");
  command.flag("--quiet", o->quiet, "No notes on stderr");
  command.footer(
      "Example: frustum check cone.nc --machine iwf-bc --fail-on warning\n"
      "Exit code 1 when a finding is at or above the severity of --fail-on; docs/check.md has all "
      "checks.");
  command.runs([o] { return check_file(*o); });
}

}  // namespace frustum::app

// frustum parse: NC text to canonical motions.
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/job/nc_file.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "parser/doubts.hpp"
#include "parser/tool_table.hpp"
#include "parser/writing/canonical_json.hpp"
#include "report/exchange/json_report.hpp"

namespace frustum::app {
namespace {

struct ParseOptions : AnswerOptions {
  std::string file{};
  SetupWords setup_words{};
  std::string dialect{};  // recognised when not given
  bool canon = false;
  bool block_delete = false;
  std::string tools{};  // a tool table
  bool inch_machine = false;
  std::vector<std::string> search_path{};
};

Result<parser::InterpreterOptions> run_options(const ParseOptions& options) {
  const auto known = known_setup_of(options.setup_words);
  if (!known) return known.error();
  parser::InterpreterOptions run = options_for(options.file);
  known->tell(run);
  run.block_delete = options.block_delete;
  // Diameters are the job's to know.
  run.contours_without_diameter = true;
  if (options.inch_machine) run.machine_unit = parser::LengthUnit::inch;
  run.search_path.insert(run.search_path.end(), options.search_path.begin(),
                         options.search_path.end());
  if (options.tools.empty()) return run;
  auto tools = parser::read_tool_table(options.tools, run.machine_unit);
  if (!tools) return tools.error();
  run.tools = *std::move(tools);
  run.tools_are_all = true;
  return run;
}

// What of a program is told without its motions.
class Tally {
 public:
  void count(const parser::Motion& motion) {
    ++motions_[parser::type_of(motion.command)];
    if (std::holds_alternative<parser::Event>(motion.command)) events_.push_back(motion);
  }
  [[nodiscard]] std::string json(const std::string& file, const NcFile& nc,
                                 std::uint64_t blocks) const {
    nlohmann::ordered_json doc{{"schema", "frustum/parse/1"},
                               {"version", program_version()},
                               {"program", file},
                               {"dialect", name_of(nc.program.dialect)}};
    doc["recognised_by"] = nullptr;
    if (!nc.reason.empty()) doc["recognised_by"] = nc.reason;
    doc["blocks"] = blocks;
    doc["motions"] = motions_;
    doc["diagnostics"] = nlohmann::ordered_json::parse(
        report::diagnostics_json(in_file(parser::doubts_of(events_), file)));
    return doc.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  }

 private:
  std::map<std::string_view, std::uint64_t> motions_{};
  std::vector<parser::Motion> events_{};
};

int parse_file(const ParseOptions& options) {
  if (options.canon && options.json) {
    return refuse(error("conflicting-options"_id, "give either --canon or --json",
                        "--canon prints a JSON line a motion, --json one document"),
                  options);
  }
  const auto nc = open_nc(options.file, options.dialect);
  if (!nc) return refuse(nc.error(), options);
  if (!nc->reason.empty() && !options.quiet && !options.json) {
    std::cerr << "note: read as " << name_of(nc->program.dialect) << " (" << nc->reason << ")\n";
  }
  const auto run = run_options(options);
  if (!run) return refuse(run.error(), options);
  Tally tally;
  const auto take = [&](parser::Motion&& motion) {
    if (options.canon) std::cout << parser::to_json_line(motion) << '\n';
    if (options.json) tally.count(motion);
  };
  const auto summary = parser::interpret(nc->program, take, *run);
  if (summary) {
    if (options.json) std::cout << tally.json(options.file, *nc, summary->blocks);
    return kDone;
  }
  // What reads the motions alone must not take a part for the whole program.
  if (options.canon) std::cout << parser::to_json_line(summary.error().front()) << '\n';
  std::cout.flush();
  return refuse(summary.error(), options);
}

}  // namespace

void add_parse(Command& program) {
  auto options = std::make_shared<ParseOptions>();
  Command command = program.command("parse", "Check an NC program and print its canonical motions");
  command.option("file", options->file, "NC program, or - for the standard input").required();
  command
      .option("--dialect", options->dialect,
              "fanuc (or iso), linuxcnc, sinumerik, heidenhain or cldata (default: recognised "
              "from the file, with the reason on stderr)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  command.flag("--canon", options->canon,
               "Print one JSON line a motion (mm, degrees, mm/min); where the program cannot be "
               "run on, the last line has the type error");
  add_answer_options(command, *options);
  command.flag("--block-delete", options->block_delete, "Leave out blocks that begin with /");
  command.option("--tools", options->tools,
                 "LinuxCNC tool table: G43, M6 and M61 take its tools alone");
  command.flag("--inch-machine", options->inch_machine,
               "The tool table and parameters such as #5221 count in inches (default: mm)");
  command
      .option("--search,--search-path", options->search_path,
              "Folder with subprograms, after the program's own; may be repeated")
      .existing_folder();
  add_setup_options(command, options->setup_words);
  add_control_options(command, options->setup_words);
  command.footer("Example: frustum parse cone.nc --canon");
  command.runs([options] { return parse_file(*options); });
}

}  // namespace frustum::app

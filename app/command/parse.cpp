// frustum parse: NC text to canonical motions.
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/job/nc_file.hpp"
#include "app/view/console.hpp"
#include "parser/tool_table.hpp"
#include "parser/writing/canonical_json.hpp"

namespace frustum::app {
namespace {

struct ParseOptions {
  std::string file{};
  SetupWords setup_words{};
  std::string dialect{};  // recognised when not given
  bool canon = false;
  bool quiet = false;
  bool block_delete = false;
  std::string tools{};  // a tool table
  bool inch_machine = false;
  std::vector<std::string> search_path{};
};

int parse_file(const ParseOptions& options) {
  const auto nc = open_nc(options.file, options.dialect);
  if (!nc) return refuse(nc.error());
  if (!nc->reason.empty() && !options.quiet) {
    std::cerr << "note: read as " << name_of(nc->program.dialect) << " (" << nc->reason << ")\n";
  }
  const auto print = [&](parser::Motion&& motion) {
    if (options.canon) std::cout << parser::to_json_line(motion) << '\n';
  };
  const auto known = known_setup_of(options.setup_words);
  if (!known) return refuse(known.error());
  parser::InterpreterOptions run = options_for(options.file);
  known->tell(run);
  run.block_delete = options.block_delete;
  // Diameters are the job's to know.
  run.contours_without_diameter = true;
  if (options.inch_machine) run.machine_unit = parser::LengthUnit::inch;
  run.search_path.insert(run.search_path.end(), options.search_path.begin(),
                         options.search_path.end());
  if (!options.tools.empty()) {
    auto tools = parser::read_tool_table(options.tools, run.machine_unit);
    if (!tools) return refuse(tools.error());
    run.tools = *std::move(tools);
    run.tools_are_all = true;
  }
  const auto summary = parser::interpret(nc->program, print, run);
  if (summary) return kDone;
  // What reads the motions alone must not take a part for the whole program.
  if (options.canon) std::cout << parser::to_json_line(summary.error().front()) << '\n';
  std::cout.flush();
  return refuse(summary.error());
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
  command.flag("--quiet", options->quiet, "Do not say which dialect was recognised");
  command.flag("--canon", options->canon,
               "Print one JSON line a motion (mm, degrees, mm/min); where the program cannot be "
               "run on, the last line has the type error");
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

// frustum post: any NC program or CLDATA for one machine, in the language of its controller.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/console.hpp"
#include "app/job.hpp"
#include "app/machine_files.hpp"
#include "app/number_check.hpp"
#include "core/whole_file.hpp"
#include "parser/interpreter.hpp"
#include "post/machine_program.hpp"
#include "post/nc_spelling.hpp"
#include "post/nc_writer.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file{};
  std::string machine{};
  std::string to{};
  std::string out{};
  std::string dialect{};  // recognised when not given
  std::string form = "tcp";
  std::string arcs = "keep";
  std::string job{};
  std::vector<std::string> tool_lengths{};
  std::vector<std::string> offsets{};
  double tolerance = 1e-3;         // mm
  double angle_tolerance = 0.001;  // mrad
  bool no_comments = false;
  bool source_lines = false;
  bool json = false;
};

// Machine and setup, from the job and then from the command line.
struct Workshop {
  kinematics::Machine machine;
  kinematics::Setup setup{};
};

// "5=120.5"
Result<std::pair<std::string, std::string>> halves_of(const std::string& text, const char* what,
                                                      const char* example) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0) {
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
  }
  return error(fmt::format("{} {}: expected {}", what, text, example));
}

std::optional<Diagnostic> add_tool_length(const std::string& text, kinematics::Setup& setup) {
  const auto halves = halves_of(text, "--tool-length", "NUMBER=LENGTH, for example 1=150");
  if (!halves) return halves.error().front();
  const auto number = numbers_of(halves->first, 1, "--tool-length");
  const auto length = numbers_of(halves->second, 1, "--tool-length");
  if (!number) return number.error().front();
  if (!length) return length.error().front();
  const double n = number->front();
  if (!(n >= 1.0 && n <= 99999.0 && n == std::floor(n))) {
    return error(fmt::format("--tool-length {}: a tool is named by its number", text),
                 "1 to 99999");
  }
  setup.tools[static_cast<int>(n)].length = length->front();
  return std::nullopt;
}

std::optional<Diagnostic> add_offset(const std::string& text, kinematics::Setup& setup) {
  const auto halves = halves_of(text, "--offset", "G54=X,Y,Z in mm");
  if (!halves) return halves.error().front();
  for (int number = 1; number <= 6; ++number) {
    if (halves->first != fmt::format("G{}", 53 + number)) continue;
    const auto origin = numbers_of(halves->second, 3, "--offset");
    if (!origin) return origin.error().front();
    setup.work_offsets[number] = Vec3((*origin)[0], (*origin)[1], (*origin)[2]);
    return std::nullopt;
  }
  return error(fmt::format("--offset {}: no such work offset", halves->first), "G54 to G59");
}

Result<Workshop> workshop_of(const Options& options) {
  kinematics::Setup setup;
  std::optional<kinematics::Machine> machine;
  if (!options.job.empty()) {
    auto job = load_job(options.job, {}, false);
    if (!job) return job.error();
    setup.table_from_workpiece = job->piece.placement.table_from_workpiece();
    setup.work_offsets = job->piece.work_offsets;
    for (const auto& [number, tool] : job->piece.tools) {
      setup.tools[number] = {tool.length.value, tool.length_error.value, tool.flute_length.value};
    }
    machine = job->machine;
  } else {
    // The table's own origin is what a program without a setup sheet means.
    setup.work_offsets[1] = Vec3::Zero();
  }
  for (const std::string& text : options.tool_lengths) {
    if (auto problem = add_tool_length(text, setup)) return *problem;
  }
  for (const std::string& text : options.offsets) {
    if (auto problem = add_offset(text, setup)) return *problem;
  }
  if (!options.machine.empty()) {
    auto loaded = kinematics::Machine::load(find_machine(options.machine, "."));
    if (!loaded) return loaded.error();
    machine = *std::move(loaded);
  }
  if (!machine) return error("no machine", "name one with --machine, or a job with --job");
  return Workshop{*std::move(machine), std::move(setup)};
}

Result<std::vector<parser::Motion>> motions_of_file(const Options& options) {
  std::ifstream in(options.file, std::ios::binary);
  std::ostringstream text;
  if (in && fs::is_regular_file(options.file)) text << in.rdbuf();
  if (!in || text.view().empty()) {
    Diagnostic failure = error("the file cannot be read", "check the path and permissions");
    failure.file = options.file;
    return failure;
  }
  const auto dialect = parser::dialect_named(options.dialect)
                           .value_or(parser::recognise_dialect(text.view(), options.file).dialect);
  const auto program = parser::parse_program(text.view(), options.file, dialect);
  if (!program) return program.error();
  return parser::motions_of(*program);
}

post::PlanOptions plan_options(const Options& options, const post::NcSpelling& spelling) {
  post::PlanOptions plan;
  plan.output = options.form == "axes"      ? post::OutputForm::axes
                : options.form == "vectors" ? post::OutputForm::vectors
                                            : post::OutputForm::tip;
  plan.arcs = options.arcs == "none"         ? post::ArcForm::none
              : spelling.circle_centre_block ? post::ArcForm::flat
                                             : post::ArcForm::all;
  plan.great_circle = !spelling.orientation_paths[1].empty();
  plan.tolerance = Mm{options.tolerance};
  plan.angle_tolerance = Rad{options.angle_tolerance * 1e-3};
  return plan;
}

// Controllers take letters, digits and _.
std::string program_name(const fs::path& out) {
  std::string name = out.stem().string();
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    c = std::isalnum(byte) != 0 ? static_cast<char>(std::toupper(byte)) : '_';
  }
  return name.empty() ? "FRUSTUM" : name;
}

Diagnostics in_file(Diagnostics diagnostics, const std::string& file) {
  for (Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.file.empty() && diagnostic.line > 0) diagnostic.file = file;
  }
  return diagnostics;
}

int post_process(const Options& options) {
  std::error_code ignored;
  if (fs::equivalent(options.file, options.out, ignored)) {
    return refuse("the output would overwrite the program it is made from", "choose another -o");
  }
  const auto workshop = workshop_of(options);
  if (!workshop) return refuse(workshop.error());
  const auto motions = motions_of_file(options);
  if (!motions) return refuse(motions.error());
  const auto dialect = *parser::dialect_named(options.to);
  const auto plan = post::plan_for_machine(workshop->machine, workshop->setup, *motions,
                                           plan_options(options, *post::spelling_of(dialect)));
  if (!plan) return refuse(in_file(plan.error(), options.file));
  const auto program = post::write_nc(plan->motions, dialect,
                                      {.name = program_name(options.out),
                                       .comments = !options.no_comments,
                                       .source_lines = options.source_lines});
  if (!program) return refuse(in_file(program.error(), options.file));
  const auto written = write_whole_file(options.out, program->text);
  if (!written) return refuse(written.error());

  const Diagnostics warnings = in_file(plan->warnings, options.file);
  if (options.json) {
    nlohmann::ordered_json told{{"output", written->string()},
                                {"dialect", parser::name_of(dialect)},
                                {"machine", workshop->machine.name()},
                                {"lines", program->source_lines.size()},
                                {"inserted_points", plan->inserted},
                                {"rewinds", plan->rewinds},
                                {"diagnostics", nlohmann::ordered_json::array()}};
    for (const Diagnostic& warning : warnings) told["diagnostics"].push_back(to_string(warning));
    std::cout << told.dump(2) << '\n';
    return kDone;
  }
  print(std::cerr, warnings);
  std::cout << fmt::format("{}: {} lines, {} points inserted, {} rewinds\n", written->string(),
                           program->source_lines.size(), plan->inserted, plan->rewinds);
  return kDone;
}

}  // namespace

void add_post(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "post", "Rewrite an NC program or APT CLDATA for a machine and its controller");
  command->add_option("file", o->file, "Program: tool vectors, rotary words or axis positions")
      ->required();
  command->add_option("--machine", o->machine,
                      "Machine file, or the name of a shipped machine (default: the job's)");
  command->add_option("--to", o->to, "fanuc (or iso), linuxcnc, sinumerik, heidenhain")
      ->required()
      ->check(CLI::IsMember({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain"}));
  command->add_option("-o,--out", o->out, "File to write")->required();
  command->add_option("--dialect", o->dialect, "Of the program (default: recognised)")
      ->check(CLI::IsMember({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"}));
  command
      ->add_option("--output", o->form,
                   "tcp: tip and rotary axes (default); vectors: tip and tool vector; axes: axis "
                   "positions, tool-centre-point control off")
      ->check(CLI::IsMember({"tcp", "vectors", "axes"}));
  command->add_option("--arcs", o->arcs, "keep (default, where the machine can) or none")
      ->check(CLI::IsMember({"keep", "none"}));
  command
      ->add_option("--tolerance", o->tolerance, "Of the tip where points are inserted, mm (0.001)")
      ->check(positive_number(1.0));
  command
      ->add_option("--angle-tolerance", o->angle_tolerance,
                   "Of the tool axis where points are inserted, mrad (0.001)")
      ->check(positive_number(100.0));
  command->add_option("--job", o->job, "Takes machine, tool lengths and work offsets from a job");
  command->add_option("--tool-length", o->tool_lengths, "NUMBER=LENGTH in mm, repeated");
  command->add_option("--offset", o->offsets,
                      "G54=X,Y,Z: program origin in the table frame, mm, repeated (G54=0,0,0)");
  command->add_flag("--no-comments", o->no_comments, "Leave comments out");
  command->add_flag("--source-lines", o->source_lines,
                    "Behind each block, the line of the program that it came from");
  command->add_flag("--json", o->json, "Say what was written as JSON");
  command->footer(
      "Example: frustum post cone.nc --machine iwf-bc --to heidenhain --output axes "
      "--tool-length 1=150 --offset G54=-65,0,150 -o cone.h");
  command->callback([o, &exit_code] { exit_code = post_process(*o); });
}

}  // namespace frustum::app

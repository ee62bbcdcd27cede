// frustum post: any NC program or CLDATA for one machine, in the language of its controller.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_setup.hpp"
#include "app/job/nc_file.hpp"
#include "app/view/console.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"
#include "parser/doubts.hpp"
#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/motion_writer.hpp"
#include "post/planning/machine_program.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct PostOptions : AnswerOptions {
  std::string file{};
  SetupWords setup_words{};
  std::string to{};
  std::string out{};
  std::string dialect{};  // recognised when not given
  std::string form = "tcp";
  std::string arcs = "keep";
  double tolerance = 1e-3;         // mm
  double angle_tolerance = 0.001;  // mrad
  double pole_tolerance = 0.0001;  // mrad
  bool no_comments = false;
  bool source_lines = false;
};

post::PlanOptions plan_options(const PostOptions& options, const parser::NcSpelling& spelling) {
  post::PlanOptions plan;
  plan.output = options.form == "axes"      ? post::OutputForm::axes
                : options.form == "vectors" ? post::OutputForm::vectors
                                            : post::OutputForm::tip;
  plan.arcs = options.arcs == "none"         ? post::ArcForm::none
              : spelling.circle_centre_block ? post::ArcForm::flat
                                             : post::ArcForm::all;
  plan.length = !spelling.compensation_by_tool     ? post::LengthForm::by_number
                : spelling.no_compensation.empty() ? post::LengthForm::always_by_tool
                                                   : post::LengthForm::by_tool;
  plan.zero_is_spindle = spelling.zero_is_spindle;
  plan.great_circle = !spelling.orientation_paths[1].empty();
  plan.tolerance = Mm{options.tolerance};
  plan.angle_tolerance = Rad{options.angle_tolerance * 1e-3};
  plan.pole_tolerance = Rad{options.pole_tolerance * 1e-3};
  return plan;
}

int post_process(const PostOptions& options) {
  std::error_code ignored;
  if (fs::equivalent(options.file, options.out, ignored)) {
    return refuse(
        error("output-overwrites-input"_id,
              "the output would overwrite the program it is made from", "choose another -o"),
        options);
  }
  if (const auto fault = unwritable(options.out)) return refuse(*fault, options);
  const auto setup_words = machine_setup_of(options.setup_words);
  if (!setup_words) return refuse(setup_words.error(), options);
  const auto motions = motions_of_file(options.file, options.dialect, *setup_words);
  if (!motions) return refuse(motions.error(), options);
  const auto dialect = *parser::dialect_named(options.to);
  const auto plan = with_progress(options, "plan the axes", [&](report::Progress&) {
    return post::plan_for_machine(setup_words->machine, setup_words->setup, *motions,
                                  plan_options(options, *parser::spelling_of(dialect)));
  });
  if (!plan) return refuse(in_file(plan.error(), options.file), options);
  const auto program = parser::write_nc(plan->motions, dialect,
                                        {.name = program_name(options.out),
                                         .comments = !options.no_comments,
                                         .source_lines = options.source_lines});
  if (!program) return refuse(in_file(program.error(), options.file), options);
  const auto written = write_whole_file(options.out, program->text);
  if (!written) return refuse(written.error(), options);

  Diagnostics warnings = parser::doubts_of(*motions);
  warnings.insert(warnings.end(), plan->warnings.begin(), plan->warnings.end());
  warnings = in_file(std::move(warnings), options.file);
  if (options.json) {
    nlohmann::ordered_json written_doc{{"schema", "frustum/post/1"},
                                       {"version", program_version()},
                                       {"output", written->string()},
                                       {"dialect", parser::name_of(dialect)},
                                       {"machine", setup_words->machine.name()},
                                       {"lines", program->source_lines.size()},
                                       {"inserted_points", plan->inserted},
                                       {"rewinds", plan->rewinds},
                                       {"diagnostics", nlohmann::ordered_json::array()},
                                       {"diagnostic_ids", nlohmann::ordered_json::array()}};
    for (const Diagnostic& warning : warnings) {
      written_doc["diagnostics"].push_back(to_string(warning));
      written_doc["diagnostic_ids"].push_back(warning.id.text());
    }
    std::cout << written_doc.dump(2) << '\n';
    return kDone;
  }
  print(std::cerr, warnings);
  if (options.quiet) return kDone;
  std::cout << fmt::format("{}: {}, {} inserted, {}\n", written->string(),
                           counted(program->source_lines.size(), "line"),
                           counted(plan->inserted, "point"), counted(plan->rewinds, "rewind"));
  return kDone;
}

}  // namespace

void add_post(Command& program) {
  auto o = std::make_shared<PostOptions>();
  Command command = program.command(
      "post", "Rewrite an NC program or APT CLDATA for a machine and its controller");
  command.option("file", o->file, "Program: tool vectors, rotary words or axis positions")
      .required();
  command.option("--to", o->to, "fanuc (or iso), linuxcnc, sinumerik, heidenhain")
      .required()
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain"});
  command.option("-o,--out", o->out, "File to write").required();
  command.option("--dialect", o->dialect, "Of the program (default: recognised)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  command
      .option("--output", o->form,
              "tcp: tip and rotary axes (default); vectors: tip and tool vector; axes: axis "
              "positions, tool centre point control off")
      .one_of({"tcp", "vectors", "axes"});
  command.option("--arcs", o->arcs, "keep (default, where the machine can) or none")
      .one_of({"keep", "none"});
  command.option("--tolerance", o->tolerance, "Of the tip where points are inserted, mm (0.001)")
      .holds(positive_number(1.0));
  command
      .option("--angle-tolerance", o->angle_tolerance,
              "Of the tool axis where points are inserted, mrad (0.001)")
      .holds(positive_number(100.0));
  command
      .option("--pole-tolerance", o->pole_tolerance,
              "Tool vectors nearer to the pole than this leave the turning axis at rest; the tool "
              "axis is off by as much, mrad (0.0001)")
      .holds(positive_number(100.0));
  add_setup_options(command, o->setup_words);
  command.flag("--no-comments", o->no_comments, "Leave comments out");
  command.flag("--source-lines", o->source_lines,
               "After each block, the line of the program that it came from");
  add_answer_options(command, *o);
  command.footer(
      "Example: frustum post cone.nc --machine iwf-bc --to heidenhain --output axes "
      "--tool-length 1=150 --offset G54=-65,0,150 -o cone.h");
  command.computes([o] { return post_process(*o); });
}

}  // namespace frustum::app

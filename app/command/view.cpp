// frustum view: a page that plays a program on the machine.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/trial_run.hpp"
#include "app/player/played_path.hpp"
#include "app/player/played_program.hpp"
#include "app/player/player_bodies.hpp"
#include "app/player/player_steps.hpp"
#include "app/view/console.hpp"
#include "core/counted.hpp"
#include "core/file_set.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"
#include "parser/dialect.hpp"
#include "report/player/player_page.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ViewOptions : AnswerOptions {
  PlayerWords words{};
  std::string out{};
  StepRequest steps{};
  bool asks_for_workpiece = false;  // --snapshots or --pitch are given, and not for none
};

struct Played {
  PlayedProgram program;
  trials::CommandedPiece commanded{};
  PlayedPath path{};
  std::vector<WorkpieceStep> steps{};
};

// Files go to --out, else beside the job or program into out/.
fs::path folder_of(const ViewOptions& options) {
  if (!options.out.empty()) return options.out;
  return fs::path(options.words.file).parent_path() / "out";
}

// What no module could give a place belongs to the file that is played.
Diagnostics in_played(Diagnostics problems, const Job& job) {
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = d.line > 0 ? job.piece.program_file : job.file.string();
  }
  return problems;
}

// The workpiece in steps, of a job.
Result<std::vector<WorkpieceStep>> cut_in_steps(const ViewOptions& options, Played& played,
                                                const kinematics::GeometricErrors& errors,
                                                TrialRun& run) {
  const Job& job = played.program.job;
  trials::TrialOptions trial = trial_options_of(job);
  trial.measure = trial.find_collisions = false;
  run.begin("cut");
  const auto cut =
      trials::run_trial(job.machine, errors, job.piece, played.commanded, job.cmm, trial);
  if (!cut) return cut.error();
  print(std::cerr, cut->wrong_cuts);
  run.begin("mesh the steps");
  return workpiece_steps(job, *cut->workpiece, options.steps,
                         [&run](double share) { run.at(share); });
}

Result<Played> play(const ViewOptions& options, TrialRun& run) {
  auto program = played_program(options.words);
  if (!program) return program.error();
  Played played{.program = *std::move(program)};
  const Job& job = played.program.job;
  if (!played.program.has_blank && options.asks_for_workpiece) {
    return error("conflicting-options"_id,
                 "--snapshots and --pitch are of a workpiece, and a program alone has no blank",
                 "name a job that has one with --job, or leave them out");
  }
  for (const std::string& note : played.program.notes) std::cerr << "note: " << note << '\n';
  run.begin("execute");
  auto commanded = trials::command_piece(job.machine, job.piece);
  if (!commanded) return in_played(commanded.error(), job);
  played.commanded = *std::move(commanded);
  print(std::cerr, played.commanded.warnings);
  const auto errors = trials::errors_for(job.machine, job.errors, job.piece, played.commanded);
  if (!errors) return in_played(errors.error(), job);
  run.begin("travel");
  auto path = played_path(job, played.commanded, *errors);
  if (!path) return in_played(path.error(), job);
  played.path = *std::move(path);
  if (played.path.points.empty()) {
    Diagnostic idle = error("no-motion"_id, "the program moves no tool: there is nothing to play",
                            "check that it is the right file and that it calls a tool (T1 M6)");
    idle.file = job.piece.program_file;
    return idle;
  }
  if (played.program.has_blank && options.steps.count > 0) {
    auto steps = cut_in_steps(options, played, *errors, run);
    if (!steps) return in_played(steps.error(), job);
    played.steps = *std::move(steps);
  }
  run.end();
  return played;
}

// --- the page ------------------------------------------------------------------------------------

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string errors_text(const Job& job) {
  std::string text;
  for (const kinematics::ErrorEntry& e : job.errors) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", e.name, e.written);
  }
  return text.empty() ? "none" : text;
}

std::size_t line_count(const std::string& text) {
  const auto ends = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  return text.empty() || text.ends_with('\n') ? ends : ends + 1;
}

Facts facts_of(const Played& played) {
  const Job& job = played.program.job;
  const fs::path program = fs::path(job.piece.program_file).filename();
  return {
      {"Machine", fmt::format("{} ({})", job.machine.title(), job.machine.name())},
      {"NC program", fmt::format("{}, {}, {}", program.string(), parser::name_of(job.piece.dialect),
                                 counted(line_count(job.piece.program), "line"))},
      {"Motion", fmt::format("{} in {:.1f} s", counted(played.path.blocks.size(), "block"),
                             played.path.cycle_time)},
      {"Errors of the machine", errors_text(job)},
      {"Largest deviation of the tip",
       fmt::format("{:.3f} µm", played.path.largest_deviation * kUmPerMm)},
      {"Drawn", fmt::format("{}, {} of the workpiece", counted(played.path.points.size(), "point"),
                            counted(played.steps.size(), "step"))}};
}

std::vector<std::string> notes_of(const Played& played) {
  std::vector<std::string> notes = played.program.notes;
  const Job& job = played.program.job;
  if (job.machine.bodies().empty()) {
    notes.push_back("The machine file states no bodies: the machine itself is not drawn.");
  }
  if (!played.program.has_blank) {
    notes.push_back("A program alone has no blank: play a job to see the workpiece.");
  }
  if (played.path.left_out > 0) {
    notes.push_back(fmt::format("{} of the path are left out for the size of this page.",
                                counted(played.path.left_out, "point")));
  }
  return notes;
}

std::string deviation_text(const PlayedPath& path) {
  return path.by_place
             ? "of the tip, from the nearest place of the path that is programmed, "
               "with all errors, lags and vibrations of the job."
             : "of the tip, from that of the error-free machine at the same axis positions.";
}

// The texts of the main program and of the files whose blocks are on the path; blocks say which.
Result<std::vector<report::PlayerText>> texts_of(const Played& played,
                                                 std::vector<report::PlayerBlock>& blocks) {
  const programs::TestPiece& piece = played.program.job.piece;
  std::vector<report::PlayerText> texts{
      {fs::path(piece.program_file).filename().string(), piece.program}};
  std::vector<std::string> files{piece.program_file};
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto& file = played.path.blocks[k].source_file;
    if (file == nullptr) continue;
    auto at = std::ranges::find(files, *file);
    if (at == files.end()) {
      auto text = read_whole_file(*file);
      if (!text) return text.error();
      files.push_back(*file);
      texts.push_back({fs::path(*file).filename().string(), *std::move(text)});
      at = std::prev(files.end());
    }
    blocks[k].text = static_cast<std::uint32_t>(at - files.begin());
  }
  return texts;
}

Result<report::PlayerPage> page_of(const Played& played) {
  const Job& job = played.program.job;
  report::PlayerPage page;
  page.title = job.piece.title.empty() ? fs::path(job.piece.program_file).filename().string()
                                       : job.piece.title;
  page.facts = facts_of(played);
  page.notes = notes_of(played);
  page.deviation = deviation_text(played.path);
  std::set<int> tools;
  for (const kinematics::PathBlock& block : played.path.blocks) {
    tools.insert(block.tool);
    page.blocks.push_back({.line = block.source_line,
                           .is_rapid = block.kind == kinematics::PathKind::rapid,
                           .tool = block.tool,
                           .feed = block.feed});
  }
  auto texts = texts_of(played, page.blocks);
  if (!texts) return texts.error();
  page.texts = *std::move(texts);
  for (const PathPoint& point : played.path.points) {
    report::PlayerPoint drawn{.time = point.time,
                              .tip = point.tip,
                              .deviation = point.deviation,
                              .feed = point.feed,
                              .block = point.block,
                              .starts = point.starts};
    for (const kinematics::Joint& joint : job.machine.joints()) {
      drawn.axes.push_back(point.axes[joint.letter]);
    }
    page.points.push_back(std::move(drawn));
  }
  for (const WorkpieceStep& step : played.steps) {
    page.steps.push_back({step.state.time, player_mesh(step.mesh)});
  }
  return with_bodies(job, {tools.begin(), tools.end()}, std::move(page));
}

// --- the summary ---------------------------------------------------------------------------------

ordered_json document_of(const Played& played, const std::string& title, std::size_t bytes) {
  const Job& job = played.program.job;
  ordered_json errors = ordered_json::object(), steps = ordered_json::array();
  for (const kinematics::ErrorEntry& e : job.errors) errors[e.name] = e.written;
  for (const WorkpieceStep& step : played.steps) {
    steps.push_back({{"time_s", step.state.time},
                     {"line", step.state.source_line},
                     {"triangles", step.mesh.triangles.size()},
                     {"volume_mm3", step.volume}});
  }
  return {{"schema", "frustum/view/1"},
          {"version", program_version()},
          {"title", title},
          {"machine", job.machine.name()},
          {"program", fs::path(job.piece.program_file).filename().string()},
          {"lines", line_count(job.piece.program)},
          {"blocks", played.path.blocks.size()},
          {"cycle_time_s", played.path.cycle_time},
          {"errors", std::move(errors)},
          {"largest_deviation_um", played.path.largest_deviation * kUmPerMm},
          {"points", played.path.points.size()},
          {"points_left_out", played.path.left_out},
          {"chord_um", played.path.bound * kUmPerMm},
          {"steps", std::move(steps)},
          {"page_bytes", bytes}};
}

int view(const ViewOptions& options) {
  if (options.steps.pitch > 0.0 && options.steps.count == 0) {
    return refuse(error("conflicting-options"_id, "--pitch is of the workpiece, which is left out",
                        "give --snapshots 1 or more"),
                  options);
  }
  auto set = FileSet::open(folder_of(options), {"view.html", "view.json"});
  if (!set) return refuse(set.error(), options);
  TrialRun run(progress_style(options));
  const auto played = play(options, run);
  if (!played) return refuse(played.error(), options);
  const auto page = page_of(*played);
  if (!page) return refuse(page.error(), options);
  std::string html = report::player_html(*page);
  const ordered_json document = document_of(*played, page->title, html.size());
  const double megabytes = static_cast<double>(html.size()) / 1e6;
  const fs::path file = set->add("view.html", std::move(html));
  set->add("view.json", document.dump(1) + "\n");
  if (const auto written = set->write(); !written) return refuse(written.error(), options);
  if (options.json) {
    std::cout << document.dump(1) << '\n';
  } else if (!options.quiet) {
    std::cout << fmt::format("{} ({:.1f} MB): {} in {:.1f} s, {}, {} of the workpiece\n",
                             file.string(), megabytes, counted(played->path.blocks.size(), "block"),
                             played->path.cycle_time, counted(played->path.points.size(), "point"),
                             counted(played->steps.size(), "step"));
  }
  return kDone;
}

}  // namespace

void add_view(Command& program) {
  auto o = std::make_shared<ViewOptions>();
  Command command =
      program.command("view", "A page that plays a program on the machine: axes, tool, workpiece");
  command
      .option("file", o->words.file, "Job file (.toml), or an NC program with --machine or --job")
      .required();
  command.option("--out", o->out,
                 "Folder for view.html and view.json (default: out/ beside the job or program)");
  add_setup_options(command, o->words.setup);
  command
      .option("--dialect", o->words.dialect,
              "fanuc (or iso), linuxcnc, sinumerik, heidenhain or cldata (default: recognised)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"});
  add_error_options(command, o->words.overrides.errors);
  command.option("--tool-radius-error", o->words.overrides.tool_radius_error,
                 "Of every tool, with unit, for example 2um");
  command
      .option("--snapshots", o->steps.count,
              "Meshes of the workpiece at equal steps of time, after that of the blank; 0: none")
      .within(0, 200)
      .default_shown();
  command
      .option("--pitch", o->steps.pitch, "Of their sampling grid, mm (default: longest side / 120)")
      .holds(positive_number());
  add_answer_options(command, *o);
  command.footer(
      "The page needs no network. A program alone has no blank and takes errors by --error.\n"
      "Example: frustum view job.toml --out out --error EX0C=10um\n"
      "Example: frustum view part.nc --machine iwf-bc --tool-length 1=150 --offset G54=-65,0,150");
  command.computes([o, command] {
    o->asks_for_workpiece =
        o->steps.count > 0 && (command.was_given("--snapshots") || command.was_given("--pitch"));
    return view(*o);
  });
}

}  // namespace frustum::app

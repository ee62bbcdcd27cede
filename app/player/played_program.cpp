#include "app/player/played_program.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/job/nc_file.hpp"
#include "app/job/unmeasured_tools.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::app {
namespace {

constexpr double kAssumedDiameter = 10.0;  // mm, of tools that nobody gave a diameter

bool is_job(const std::string& file) {
  return parser::lower_case(std::filesystem::path(file).extension().string()) == ".toml";
}

// Of a job that is played nothing is asked that it says itself.
std::optional<Diagnostic> contradiction(const PlayerWords& words) {
  const auto refused = [](const char* option) {
    return error("conflicting-options"_id, fmt::format("{}: the job says that itself", option),
                 "change the job, or play its program: frustum view PROGRAM --job JOB");
  };
  const SetupWords& setup = words.setup;
  if (!setup.machine.empty()) return refused("--machine");
  if (!setup.job.empty()) return refused("--job");
  if (!setup.tool_lengths.empty()) return refused("--tool-length");
  if (!setup.tool_diameters.empty()) return refused("--tool-diameter");
  if (!setup.offsets.empty()) return refused("--offset");
  if (!words.dialect.empty()) return refused("--dialect");
  return std::nullopt;
}

// The tools that are known, and those that the program calls besides.
void add_tools(const std::vector<parser::Motion>& motions, const KnownSetup& known,
               PlayedProgram& played) {
  cutter::ToolList& tools = played.job.piece.tools;
  for (const auto& [number, geometry] : known.setup.tools) {
    tools.try_emplace(number).first->second.length.value = geometry.length;
  }
  kinematics::Setup setup;
  for (const auto& [number, tool] : tools) setup.tools[number] = {};
  for (const int number : unmeasured_tools(setup, {motions})) {
    tools[number].length.value = kAssumedToolLength;
    played.notes.push_back(
        fmt::format("tool {} counts as {:g} mm long; --tool-length {}=.. says "
                    "better",
                    number, kAssumedToolLength, number));
  }
  for (auto& [number, tool] : tools) {
    const auto given = known.tools.find(number);
    if (given != known.tools.end() && given->second.has_diameter) {
      tool.diameter.value = given->second.diameter;
    }
    if (tool.diameter.value > 0.0) continue;
    tool.diameter.value = kAssumedDiameter;
    played.notes.push_back(
        fmt::format("tool {} is drawn {:g} mm thick; --tool-diameter {}=.. says "
                    "better",
                    number, kAssumedDiameter, number));
  }
}

Result<PlayedProgram> bare_program(const PlayerWords& words) {
  auto known = known_setup_of(words.setup);
  if (!known) return known.error();
  if (!known->machine) {
    return error("no-machine"_id, "no machine to play the program on",
                 "name one with --machine, or a job with --job; frustum machines lists those that "
                 "are shipped");
  }
  const bool has_job = !words.setup.job.empty();
  if (!has_job && words.overrides.tool_radius_error) {
    return error("conflicting-options"_id, "--tool-radius-error: no workpiece is cut",
                 "add --job, whose tools cut a blank");
  }
  std::optional<Job> job;
  if (has_job) {
    auto loaded = load_job(words.setup.job, words.overrides, false);
    if (!loaded) return loaded.error();
    job = *std::move(loaded);
    job->machine = *known->machine;
  } else {
    job.emplace(Job{.machine = *known->machine});
    auto errors = gather_errors({}, words.overrides.errors,
                                drawn_by(words.overrides.errors, std::nullopt), job->machine);
    if (!errors) return errors.error();
    job->errors = *std::move(errors);
    job->draw = drawn_by(words.overrides.errors, std::nullopt);
  }
  const auto nc = open_nc(words.file, words.dialect);
  if (!nc) return nc.error();
  PlayedProgram played{.job = *std::move(job), .has_blank = has_job};
  programs::TestPiece& piece = played.job.piece;
  played.job.file = words.file;
  piece.program = text_of_program(nc->program.text);
  piece.program_file = nc->program.file;
  piece.dialect = nc->program.dialect;
  piece.reading.control = known->control;
  piece.work_offsets = known->setup.work_offsets;
  piece.operations.clear();  // they name lines of the job's own program
  piece.error_span.clear();
  if (piece.title.empty()) piece.title = std::filesystem::path(words.file).filename().string();
  parser::InterpreterOptions reading = options_for(words.file);
  reading.tools = known->tools;
  reading.control = known->control;
  const auto motions = parser::motions_of(nc->program, reading);
  if (!motions) return motions.error();
  add_tools(*motions, *known, played);
  return played;
}

}  // namespace

Result<PlayedProgram> played_program(const PlayerWords& words) {
  if (!is_job(words.file)) return bare_program(words);
  if (auto wrong = contradiction(words)) return *std::move(wrong);
  auto job = load_job(words.file, words.overrides, false);
  if (!job) return job.error();
  return PlayedProgram{.job = *std::move(job)};
}

}  // namespace frustum::app

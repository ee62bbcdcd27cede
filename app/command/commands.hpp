// The commands of the program, each of which adds itself to the command line, and the options that
// several share.
//
// Units  : as each option says
// Errors : those of the command line (command_line.hpp); each command reports its own on stderr
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/view/console.hpp"
#include "core/result.hpp"

namespace frustum::kinematics {
class Machine;
}  // namespace frustum::kinematics

namespace frustum::programs {
enum class ProgramForm;
}  // namespace frustum::programs

namespace frustum::report {
struct RunReport;
}  // namespace frustum::report

namespace frustum::app {

class Command;
struct ErrorWords;
struct SetupWords;

void add_run(Command& program);
void add_sensitivity(Command& program);
void add_identify(Command& program);
void add_design(Command& program);
void add_program(Command& program);
void add_parse(Command& program);
void add_check(Command& program);
void add_post(Command& program);
void add_pose(Command& program);
void add_cut(Command& program);
void add_view(Command& program);
void add_cmm(Command& program);
void add_measure(Command& program);
void add_diff(Command& program);
void add_compensate(Command& program);
void add_compare(Command& program);
void add_benchmark(Command& program);
void add_fit(Command& program);
void add_machines(Command& program);
void add_errors(Command& program);
void add_volumetric(Command& program);
void add_dynamics(Command& program);
void add_study(Command& program);
void add_motion(Command& program);
void add_reference(Command& program);
void add_serve(Command& program);

// Kinds of test pieces: commands of `program`.
void add_cone(Command& kinds);
void add_step(Command& kinds);
void add_contour(Command& kinds);
void add_s_piece(Command& kinds);
void add_surface(Command& kinds);

// The options that all kinds have: --machine, --out, --dialect.
struct PieceOptions : AnswerOptions {
  std::string machine{};
  std::string out{};
  std::string dialect = "fanuc";
};
// Writes the files of a test piece for a machine that is in a file; returns their names.
using WritesPiece = std::function<Result<std::vector<std::filesystem::path>>(
    const kinematics::Machine& machine, const std::filesystem::path& machine_file)>;
// Finds the machine by its name, writes the piece and prints the names of its files; returns the
// exit code.
int write_piece(const PieceOptions& options, const WritesPiece& write);
// How programs of five axes state the pose of the tool: what --form says, vectors where it says
// nothing and the dialect has them.
void add_form_option(Command& kind, std::string& form);
[[nodiscard]] programs::ProgramForm form_of(const std::string& form, const std::string& dialect);

// `files` says what is written to --out.
void add_piece_options(Command& kind, PieceOptions& options, const std::string& files);

// The options by which a command takes errors: --error, --errors, --draw.
void add_error_options(Command& command, ErrorWords& words);
// The options by which a command takes a machine and its set-up: --machine, --job, --tool-length,
// --offset.
void add_setup_options(Command& command, SetupWords& words);
// And those by which it takes the control's start and habits: --start, --builder-word,
// --decimal-point.
void add_control_options(Command& command, SetupWords& words);
// The options that say how a command answers: --json, --quiet.
void add_answer_options(Command& command, AnswerOptions& options);
// --export FILE, which may be repeated, besides.
struct ResultOptions : AnswerOptions {
  std::vector<std::string> exports{};
};
void add_result_options(Command& command, ResultOptions& options);
// Prints the report; returns the exit code.
int show_result(const report::RunReport& report, const ResultOptions& options);

}  // namespace frustum::app

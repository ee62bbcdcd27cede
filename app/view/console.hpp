// What every subcommand shares: exit codes, where output goes, and how failures are reported.
// Units: none. Errors: none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/result.hpp"
#include "report/progress.hpp"

namespace CLI {
class App;
}

namespace frustum::app {

// Exit codes of every command.
constexpr int kDone = 0;
constexpr int kOutOfTolerance = 1;
constexpr int kBadInput = 2;
constexpr int kInternalFault = 3;

// Columns of tables on stdout, whether a terminal or a file reads them.
constexpr int kTableWidth = 140;

// A subcommand adds itself to the command line and stores its exit code when it ran.
using Subcommand = void (*)(CLI::App& program, int& exit_code);

void add_run(CLI::App& program, int& exit_code);
void add_sensitivity(CLI::App& program, int& exit_code);
void add_identify(CLI::App& program, int& exit_code);
void add_design(CLI::App& program, int& exit_code);
void add_program(CLI::App& program, int& exit_code);
void add_parse(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_post(CLI::App& program, int& exit_code);
void add_pose(CLI::App& program, int& exit_code);
void add_cut(CLI::App& program, int& exit_code);
void add_cmm(CLI::App& program, int& exit_code);
void add_measure(CLI::App& program, int& exit_code);
void add_diff(CLI::App& program, int& exit_code);
void add_compensate(CLI::App& program, int& exit_code);
void add_fit(CLI::App& program, int& exit_code);
void add_machines(CLI::App& program, int& exit_code);
void add_errors(CLI::App& program, int& exit_code);
void add_volumetric(CLI::App& program, int& exit_code);
struct ErrorWords;
// The options by which a command takes errors: --error, --errors, --draw.
void add_error_options(CLI::App& command, ErrorWords& words);
struct SetupWords;
// The options by which a command takes a machine and its setup: --machine, --job, --tool-length,
// --offset.
void add_setup_options(CLI::App& command, SetupWords& words);
// Kinds of test pieces: subcommands of `program`.
void add_cone(CLI::App& kinds, int& exit_code);
void add_step(CLI::App& kinds, int& exit_code);

// Prints the diagnostics on stderr; returns kBadInput.
int refuse(const Diagnostics& diagnostics);
int refuse(const std::string& message, const std::string& hint = {});

// A bar on a terminal, lines in a log, nothing when quiet.
[[nodiscard]] report::ProgressStyle progress_style(bool quiet);
[[nodiscard]] bool stdout_is_terminal();

// "x,y,z" (n numbers), or a diagnostic that says what was expected.
[[nodiscard]] Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count,
                                                     const std::string& what);

// The folder, made if need be.
[[nodiscard]] Result<std::filesystem::path> output_folder(const std::filesystem::path& folder);

}  // namespace frustum::app

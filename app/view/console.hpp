// What every subcommand shares: exit codes, how wide tables are, and how failures are reported.
// Units: none. Errors: none.
#pragma once

#include <string>

#include "core/diagnostic.hpp"
#include "report/progress.hpp"

namespace frustum::app {

// Exit codes of every command.
constexpr int kDone = 0;
constexpr int kOutOfTolerance = 1;
constexpr int kBadInput = 2;
constexpr int kInternalFault = 3;

// Columns of tables on stdout, whether a terminal or a file reads them.
constexpr int kTableWidth = 140;

// Prints the diagnostics on stderr; returns kBadInput.
int refuse(const Diagnostics& diagnostics);
int refuse(DiagnosticId id, const std::string& message, const std::string& hint = {});

// The same for a command that was asked for JSON: its standard output is one document then too.
enum class Answer { text, json };
int refuse(const Diagnostics& diagnostics, Answer answer);

// Opens those of standard input, output and errors that the caller has closed, so that no file
// takes their place; they stay unusable.
void open_standard_streams();
// The exit code of a command, or kBadInput, with the cause on stderr, where its standard output
// could not be written.
[[nodiscard]] int output_lost(int exit_code);

// A bar on a terminal, lines in a log, nothing when quiet.
[[nodiscard]] report::ProgressStyle progress_style(bool quiet);
[[nodiscard]] bool stdout_is_terminal();

}  // namespace frustum::app

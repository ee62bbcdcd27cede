// What every subcommand shares: exit codes, how wide tables are, and how failures are reported.
// Units: none. Errors: none.
#pragma once

#include <iostream>
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

// How a command answers: as text; as one JSON document on stdout, failures too; without progress
// and summary.
struct AnswerOptions {
  bool json = false;
  bool quiet = false;
};
int refuse(const Diagnostics& diagnostics, const AnswerOptions& answer);
int refuse(Diagnostic problem, const AnswerOptions& answer);

// Opens those of standard input, output and errors that the caller has closed, so that no file
// takes their place; they stay unusable.
void open_standard_streams();
// The exit code of a command, or kBadInput, with the cause on stderr, where its standard output
// could not be written.
[[nodiscard]] int output_lost(int exit_code);

// A bar on a terminal that can draw one, lines in a log, nothing when quiet or with JSON.
[[nodiscard]] report::ProgressStyle progress_style(const AnswerOptions& answer);
// Does `work`, which may tell its progress, and says on stderr meanwhile what is done.
template <typename Work>
auto with_progress(const AnswerOptions& answer, const char* step, Work&& work) {
  report::Progress progress(std::cerr, progress_style(answer));
  progress.begin(step);
  return work(progress);
}
// Whether stdout is a terminal for which nobody has set NO_COLOR.
[[nodiscard]] bool stdout_has_colour();

}  // namespace frustum::app

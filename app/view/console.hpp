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

// A bar on a terminal, lines in a log, nothing when quiet.
[[nodiscard]] report::ProgressStyle progress_style(bool quiet);
[[nodiscard]] bool stdout_is_terminal();

}  // namespace frustum::app

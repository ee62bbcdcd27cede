// The outcome of a run as a page of plain text that fits a terminal.
//
// Units: each characteristic in its own; "um" and "deg" are spelt in ASCII. Control characters in
// titles and messages are replaced, so that a file name cannot steer the terminal.
// Errors: none.
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

struct TerminalOptions {
  bool colour = false;          // ANSI colours for PASS and FAIL, bold headings
  int width = 80;               // columns; longer texts wrap, at least 60
  std::size_t list_limit = 10;  // collisions and diagnostics of one kind before "and N more"
};

[[nodiscard]] std::string terminal_report(const RunReport& report,
                                          const TerminalOptions& options = {});

}  // namespace frustum::report

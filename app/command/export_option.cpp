// How a command shows its results and writes them in other formats too.
#include <iostream>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/view/console.hpp"
#include "report/exchange/json_report.hpp"
#include "report/terminal_report.hpp"

namespace frustum::app {

void add_answer_options(Command& command, AnswerOptions& options) {
  command.flag("--json", options.json, "One JSON document on stdout and nothing else");
  command.flag("--quiet", options.quiet, "No progress, no summary");
}

void add_result_options(Command& command, ResultOptions& options) {
  command.option(
      "--export", options.exports,
      "Results in another format, by the extension: .qif (QIF 3.0), .csv, .xml "
      "(JUnit), .dfq (Q-DAS), .dmo (DMIS output), .dxf (measured sections), .svg (charts), "
      ".json; may be repeated");
  add_answer_options(command, options);
}

int show_result(const report::RunReport& report, const ResultOptions& options) {
  if (options.json) {
    std::cout << report::json_report(report);
  } else if (!options.quiet) {
    std::cout << report::terminal_report(report, {.colour = stdout_has_colour()});
  }
  return report.passes() ? kDone : kOutOfTolerance;
}

}  // namespace frustum::app

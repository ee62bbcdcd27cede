#include "app/view/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "report/exchange/json_report.hpp"

namespace frustum::app {

int refuse(const Diagnostics& diagnostics) {
  print(std::cerr, diagnostics);
  return kBadInput;
}

int refuse(const Diagnostics& diagnostics, const AnswerOptions& answer) {
  if (answer.json) std::cout << report::json_failure(diagnostics);
  return refuse(diagnostics);
}

int refuse(Diagnostic problem, const AnswerOptions& answer) {
  return refuse(Diagnostics{std::move(problem)}, answer);
}

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The wrong way round, so that reading or writing it fails as it does when it is closed.
    if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

int output_lost(int exit_code) {
  std::cout.flush();
  if (std::cout.good()) return exit_code;
  // What the cause was is known again by writing once more.
  std::cout.clear();
  std::clearerr(stdout);
  errno = 0;
  std::cout << std::endl;
  const std::string cause = errno == 0 ? "writing failed" : std::strerror(errno);
  return refuse(
      Diagnostics{error("output-lost"_id, "the standard output cannot be written: " + cause,
                        "what was printed is not complete")});
}

report::ProgressStyle progress_style(const AnswerOptions& answer) {
  if (answer.quiet || answer.json) return report::ProgressStyle::silent;
  return report::style_on({.is_terminal = isatty(STDERR_FILENO) != 0,
                           .term = std::getenv("TERM"),
                           .no_color = std::getenv("NO_COLOR")});
}

bool stdout_has_colour() {
  return report::style_on({.is_terminal = isatty(STDOUT_FILENO) != 0,
                           .term = std::getenv("TERM"),
                           .no_color = std::getenv("NO_COLOR")}) == report::ProgressStyle::bar;
}

}  // namespace frustum::app

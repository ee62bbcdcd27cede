#include "app/view/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "report/exchange/json_report.hpp"

namespace frustum::app {

int refuse(const Diagnostics& diagnostics) {
  print(std::cerr, diagnostics);
  return kBadInput;
}

int refuse(const Diagnostics& diagnostics, Answer answer) {
  if (answer == Answer::json) std::cout << report::json_failure(diagnostics);
  return refuse(diagnostics);
}

int refuse(DiagnosticId id, const std::string& message, const std::string& hint) {
  return refuse(Diagnostics{error(id, message, hint)});
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
  return refuse("output-lost"_id, "the standard output cannot be written: " + cause,
                "what was printed is not complete");
}

report::ProgressStyle progress_style(bool quiet) {
  if (quiet) return report::ProgressStyle::silent;
  return isatty(STDERR_FILENO) != 0 ? report::ProgressStyle::bar : report::ProgressStyle::log;
}

bool stdout_is_terminal() { return isatty(STDOUT_FILENO) != 0; }

}  // namespace frustum::app

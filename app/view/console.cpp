#include "app/view/console.hpp"

#include <unistd.h>

#include <iostream>

namespace frustum::app {

int refuse(const Diagnostics& diagnostics) {
  print(std::cerr, diagnostics);
  return kBadInput;
}

int refuse(DiagnosticId id, const std::string& message, const std::string& hint) {
  return refuse(Diagnostics{error(id, message, hint)});
}

report::ProgressStyle progress_style(bool quiet) {
  if (quiet) return report::ProgressStyle::silent;
  return isatty(STDERR_FILENO) != 0 ? report::ProgressStyle::bar : report::ProgressStyle::log;
}

bool stdout_is_terminal() { return isatty(STDOUT_FILENO) != 0; }

}  // namespace frustum::app

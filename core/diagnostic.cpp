#include "core/diagnostic.hpp"

#include <algorithm>
#include <ostream>
#include <utility>

#include "core/printable_text.hpp"

namespace frustum {

Diagnostic error(DiagnosticId id, std::string message, std::string hint) {
  return {.id = id, .message = shortened(std::move(message)), .hint = shortened(std::move(hint))};
}

Diagnostic error(std::string message, std::string hint) {
  return {.message = shortened(std::move(message)), .hint = shortened(std::move(hint))};
}

Diagnostic warning(DiagnosticId id, std::string message, std::string hint) {
  return {.severity = Severity::warning,
          .id = id,
          .message = shortened(std::move(message)),
          .hint = shortened(std::move(hint))};
}

Diagnostic warning(std::string message, std::string hint) {
  return {.severity = Severity::warning,
          .message = shortened(std::move(message)),
          .hint = shortened(std::move(hint))};
}

std::string to_string(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.line > 0) text += ":" + std::to_string(diagnostic.line);
  if (diagnostic.line > 0 && diagnostic.column > 0) text += ":" + std::to_string(diagnostic.column);
  if (!text.empty()) text += ": ";
  text += to_string(diagnostic.severity) + ": ";
  if (!diagnostic.key.empty()) text += diagnostic.key + ": ";
  text += diagnostic.message;
  if (!diagnostic.hint.empty()) text += " (hint: " + diagnostic.hint + ")";
  return text;
}

bool has_error(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::error; });
}

void print(std::ostream& out, const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) out << printable(to_string(diagnostic)) << '\n';
}

}  // namespace frustum

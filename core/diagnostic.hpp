// What is wrong with the user's input, where, and what to do about it.
//
// A diagnostic carries the place (file, line, column, or the key path of a TOML file), the message
// with the numbers that matter, and a hint that names the remedy. It prints in the form editors
// jump to:
//   part.nc:12:7: error: G1 without a feed rate (hint: give F once before the first cutting move)
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace frustum {

enum class Severity { note, warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string file{};
  int line = 0;       // 1-based; 0 when the place is not a line
  int column = 0;     // 1-based; 0 when unknown
  std::string key{};  // TOML key path, for example "tool.1.diameter"
  std::string message{};
  std::string hint{};
};

using Diagnostics = std::vector<Diagnostic>;

[[nodiscard]] Diagnostic error(std::string message, std::string hint = {});
[[nodiscard]] Diagnostic warning(std::string message, std::string hint = {});

[[nodiscard]] std::string to_string(Severity severity);
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic);
[[nodiscard]] bool has_error(const Diagnostics& diagnostics);

// Writes one line per diagnostic.
void print(std::ostream& out, const Diagnostics& diagnostics);

}  // namespace frustum

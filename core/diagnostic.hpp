// What is wrong with the user's input, where, and what to do about it.
//
// A diagnostic carries a stable id, the place (file, line, column, or the key path of a TOML file),
// the message with the numbers that matter, and a hint that names the remedy. It prints in the form
// editors jump to:
//   part.nc:12:7: error: G1 without a feed rate (hint: give F once before the first cutting move)
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace frustum {

enum class Severity { note, warning, error };

// What is wrong, as code, JSON, SARIF, tests and documentation name it: words in small letters
// joined by hyphens, which stay when the message is worded better. Written "arc-radius"_id.
class DiagnosticId {
 public:
  constexpr DiagnosticId() = default;
  [[nodiscard]] constexpr std::string_view text() const { return text_; }
  constexpr bool operator==(const DiagnosticId&) const = default;

 private:
  friend consteval DiagnosticId operator""_id(const char* text, std::size_t length);
  constexpr explicit DiagnosticId(std::string_view text) : text_(text) {}
  std::string_view text_ =
      "input";  // of a literal; this one: the input is wrong, nothing more exact
};

consteval DiagnosticId operator""_id(const char* text, std::size_t length) {
  for (std::size_t i = 0; i < length; ++i) {
    const char c = text[i];
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-')) {
      throw "an id has small letters, digits and hyphens";  // a compile-time error
    }
  }
  return DiagnosticId(std::string_view(text, length));
}

struct Diagnostic {
  Severity severity = Severity::error;
  DiagnosticId id{};
  std::string file{};
  int line = 0;       // 1-based; 0 when the place is not a line
  int column = 0;     // 1-based; 0 when unknown
  std::string key{};  // TOML key path, for example "tool.1.diameter"
  std::string message{};
  std::string hint{};
};

using Diagnostics = std::vector<Diagnostic>;

[[nodiscard]] Diagnostic error(DiagnosticId id, std::string message, std::string hint = {});
[[nodiscard]] Diagnostic error(std::string message, std::string hint = {});
[[nodiscard]] Diagnostic warning(DiagnosticId id, std::string message, std::string hint = {});
[[nodiscard]] Diagnostic warning(std::string message, std::string hint = {});

[[nodiscard]] std::string to_string(Severity severity);
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic);
[[nodiscard]] bool has_error(const Diagnostics& diagnostics);

// Writes one line per diagnostic.
void print(std::ostream& out, const Diagnostics& diagnostics);

}  // namespace frustum

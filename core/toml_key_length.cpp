#include "core/toml_key_length.hpp"

#include <algorithm>

namespace frustum {
namespace {

// How many bytes the string at the start of `text` has: basic or literal, of one line or several.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const bool escapes = quote == '"';
  const std::string_view triple = escapes ? "\"\"\"" : "'''";
  const bool several_lines = text.starts_with(triple);
  const std::string_view end = several_lines ? triple : triple.substr(0, 1);
  for (std::size_t at = end.size(); at < text.size(); ++at) {
    if (text[at] == '\n' && !several_lines) return at;
    if (text.substr(at).starts_with(end)) return at + end.size();
    if (text[at] == '\\' && escapes) ++at;
  }
  return text.size();
}

TextPlace place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {static_cast<int>(std::ranges::count(before, '\n')) + 1,
          static_cast<int>(at - line_start) + 1};
}

}  // namespace

std::optional<TextPlace> overlong_key(std::string_view text) {
  int dots = 0;
  std::size_t start = 0;  // of the key
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at += string_length(text.substr(at));
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '.') {
      if (++dots == kMostNamesInKey) return place_of(text, start);
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      dots = 0;
      start = at + 1;
    }
    ++at;
  }
  return std::nullopt;
}

}  // namespace frustum

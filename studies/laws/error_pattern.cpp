#include "studies/laws/error_pattern.hpp"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "core/spelling.hpp"

namespace frustum::studies {
namespace {

using Kind = kinematics::ErrorShape::Kind;

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

Diagnostic wrong_pattern(std::string_view text, const std::string& what, std::string hint) {
  return error("scale-pattern"_id, fmt::format("pattern '{}': {}", text, what), std::move(hint));
}

}  // namespace

bool matches_wildcards(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() == '*') {
    return matches_wildcards(pattern.substr(1), text) ||
           (!text.empty() && matches_wildcards(pattern, text.substr(1)));
  }
  return !text.empty() && (pattern.front() == '?' || pattern.front() == text.front()) &&
         matches_wildcards(pattern.substr(1), text.substr(1));
}

std::string iso_name(const kinematics::Machine& machine, const std::string& name) {
  if (const auto alias = machine.aliases().find(name); alias != machine.aliases().end())
    return alias->second.error.text();
  const auto error = kinematics::ErrorName::parse(name);
  return error ? error->text() : name;
}

Result<ErrorPattern> ErrorPattern::parse(std::string_view text) {
  const std::size_t colon = text.find(':');
  ErrorPattern pattern{.name = std::string(without_blanks(text.substr(0, colon)))};
  if (pattern.name.empty())
    return wrong_pattern(text, "names no error", "write \"E?X:harmonic 2\" or \"ECB\"");
  if (colon == std::string_view::npos) return pattern;
  const std::string_view shape = without_blanks(text.substr(colon + 1));
  const std::size_t blank = shape.find(' ');
  const std::string_view word = shape.substr(0, blank);
  std::vector<std::string> known;
  for (int k = 0; k <= static_cast<int>(Kind::surface); ++k) {
    known.emplace_back(kinematics::name_of(static_cast<Kind>(k)));
    if (word == known.back()) pattern.kind = static_cast<Kind>(k);
  }
  if (!pattern.kind) {
    return wrong_pattern(text, fmt::format("'{}' is no kind of shape", word),
                         suggestion(word, known));
  }
  if (blank == std::string_view::npos) return pattern;
  const std::string_view number = without_blanks(shape.substr(blank));
  int order = 0;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), order);
  if (*pattern.kind != Kind::harmonic || read.ec != std::errc() ||
      read.ptr != number.data() + number.size() || order < 1) {
    return wrong_pattern(text, fmt::format("'{}' is not the order of a harmonic", number),
                         "write \"E?X:harmonic 2\"");
  }
  pattern.order = order;
  return pattern;
}

bool ErrorPattern::matches(std::string_view error, const kinematics::ErrorShape& shape) const {
  return (!kind || shape.kind == *kind) && (!order || shape.order == *order) &&
         matches_wildcards(name, error);
}

}  // namespace frustum::studies

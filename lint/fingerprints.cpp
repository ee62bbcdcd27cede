#include "lint/fingerprints.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

namespace frustum::lint {
namespace {

// The line without blanks and the number of its block, which programs are renumbered by.
std::string bare_line(std::string_view line) {
  std::string bare;
  for (const char c : line) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) bare += c;
  }
  const auto is_digit = [&bare](std::size_t i) {
    return i < bare.size() && std::isdigit(static_cast<unsigned char>(bare[i])) != 0;
  };
  std::size_t digits = !bare.empty() && (bare[0] == 'N' || bare[0] == 'n') ? 1 : 0;
  const std::size_t first = digits;
  while (is_digit(digits)) ++digits;
  return digits > first ? bare.substr(digits) : bare;
}

// FNV-1a: the same on every machine.
std::uint64_t hash_of(std::string_view id, std::string_view line) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::string_view part : {id, line}) {
    for (const char byte : part) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
    }
  }
  return hash;
}

}  // namespace

std::string fingerprint_of(const Finding& finding, const SourceLines& lines) {
  std::string text = finding.alike;
  if (text.empty()) {
    const auto line = lines.find({finding.file, finding.line});
    if (line != lines.end()) text = bare_line(line->second);
  }
  return fmt::format("{:016x}", hash_of(info_of(finding.check).id, text));
}

std::vector<std::string> fingerprints_of(std::span<const Finding> findings,
                                         const SourceLines& lines) {
  std::vector<std::string> marks;
  std::map<std::pair<std::string, std::string>, int> seen;
  for (const Finding& finding : findings) {
    const std::string mark = fingerprint_of(finding, lines);
    marks.push_back(fmt::format("{}:{}", mark, ++seen[{finding.file, mark}]));
  }
  return marks;
}

}  // namespace frustum::lint

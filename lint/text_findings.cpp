#include "lint/text_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/printable_text.hpp"

namespace frustum::lint {
namespace {

// Longer lines are shown in part, around the column.
constexpr std::size_t kWidest = 100;

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

struct Shown {
  std::string line{};
  std::string caret{};
};
// The part of a line around `column`, and a line with a caret below it: tabs stay tabs, and the
// bytes after the first of a UTF-8 character take no room. Other control characters become blanks.
Shown shown(std::string_view line, std::size_t column) {
  const std::size_t at = column == 0 ? 0 : std::min(column - 1, line.size());
  std::size_t first = 0;
  if (line.size() > kWidest && at > kWidest / 2) first = at - kWidest / 2;
  while (first > 0 && first < line.size() && continues_character(line[first])) --first;
  std::size_t end = std::min(line.size(), first + kWidest);
  while (end < line.size() && continues_character(line[end])) ++end;
  Shown result;
  if (first > 0) result.line = result.caret = "...";
  std::fill(result.caret.begin(), result.caret.end(), ' ');
  for (std::size_t i = first; i < end; ++i) {
    const char byte = line[i];
    const unsigned code = static_cast<unsigned char>(byte);
    const bool control = (code < 0x20U && byte != '\t') || code == 0x7FU;
    result.line += control ? ' ' : byte;
    if (i < at && !continues_character(byte)) result.caret += byte == '\t' ? '\t' : ' ';
  }
  if (end < line.size()) result.line += "...";
  result.caret += '^';
  return result;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

std::string text_of(const CheckedFile& checked) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Finding& finding : checked.report.findings) {
    if (finding.suppressed != Suppressed::no) continue;
    fmt::format_to(out, "{}:{}:{}: {}: {}", printable(finding.file), finding.line, finding.column,
                   to_string(finding.severity), printable(finding.message));
    if (finding.count > 1) fmt::format_to(out, " ({} times)", finding.count);
    fmt::format_to(out, " [{}]\n", info_of(finding.check).id);
    const auto line = checked.lines.find({finding.file, finding.line});
    if (line != checked.lines.end()) {
      const Shown part = shown(line->second, finding.column);
      fmt::format_to(out, "{:>6} | {}\n       | {}\n", finding.line, part.line, part.caret);
    }
    if (!finding.hint.empty()) fmt::format_to(out, "       = {}\n", printable(finding.hint));
  }
  for (const auto& [check, count] : checked.report.left_out) {
    fmt::format_to(out, "note: {} more of [{}] are not listed\n", count, info_of(check).id);
  }
  return text;
}

std::string summary_of(std::span<const CheckedFile> checked) {
  const FindingCounts counts = counts_of(checked);
  std::string text =
      fmt::format("{}, {}, {}", counted(counts.errors, "error"),
                  counted(counts.warnings, "warning"), counted(counts.notes, "note"));
  if (counts.suppressed > 0) text += fmt::format(", {} suppressed", counts.suppressed);
  text += fmt::format(" in {} that ran", counted(counts.blocks, "block"));
  if (checked.size() != 1) text += fmt::format(", {}", counted(checked.size(), "program"));
  return text + "\n";
}

}  // namespace frustum::lint

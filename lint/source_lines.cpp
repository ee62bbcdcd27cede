#include "lint/source_lines.hpp"

#include <set>

#include "parser/reading/program_text.hpp"

namespace frustum::lint {
namespace {

void read_lines(const parser::ProgramText& text, const std::string& file,
                const std::set<std::uint32_t>& wanted, SourceLines& lines) {
  parser::LineReader reader(text);
  while (!reader.at_end()) {
    const std::uint32_t line = reader.place().line;
    if (line > *wanted.rbegin()) return;
    const std::string_view content = reader.next();
    if (wanted.contains(line)) lines.emplace(std::pair(file, line), content);
  }
}

}  // namespace

SourceLines source_lines(const parser::Program& program, std::span<const Finding> findings) {
  std::map<std::string, std::set<std::uint32_t>> wanted;
  for (const Finding& finding : findings) {
    if (finding.line > 0) wanted[finding.file].insert(finding.line);
  }
  SourceLines lines;
  for (const auto& [file, numbers] : wanted) {
    if (file == program.file) {
      read_lines(program.text, file, numbers, lines);
    } else if (const auto text = parser::ProgramText::open(file)) {
      read_lines(*text, file, numbers, lines);
    }
  }
  return lines;
}

}  // namespace frustum::lint

#include "parser/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "parser/block_reader.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

char line_end_of(std::string_view text) {
  return text.find('\n') == std::string_view::npos ? '\r' : '\n';
}

// Cuts the text into the lines of one block at a time.
class LineSource {
 public:
  struct Lines {
    std::string_view text;  // of one line, or of several joined by line feeds
    std::uint32_t first_line = 0;
    std::vector<std::uint32_t> line_starts{};
  };

  LineSource(std::string_view text, Dialect dialect)
      : rest_(text), dialect_(dialect), line_end_(line_end_of(text)) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  Lines next() {
    Lines lines{next_line(), line_, {}};
    std::size_t mark = continuation_mark(lines.text, dialect_);
    if (mark == std::string_view::npos) return lines;
    joined_ = lines.text;
    while (mark != std::string_view::npos && !at_end()) {
      const std::size_t start = joined_.size() - lines.text.size();
      // What follows the mark on its line is a remark.
      std::fill(joined_.begin() + static_cast<std::ptrdiff_t>(start + mark), joined_.end(), ' ');
      joined_ += '\n';
      lines.line_starts.push_back(static_cast<std::uint32_t>(joined_.size()));
      lines.text = next_line();
      joined_ += lines.text;
      mark = continuation_mark(lines.text, dialect_);
    }
    lines.text = joined_;
    return lines;
  }

 private:
  std::string_view next_line() {
    const std::size_t end = std::min(rest_.find(line_end_), rest_.size());
    std::string_view line = rest_.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return line;
  }

  std::string_view rest_;
  Dialect dialect_;
  char line_end_;
  std::uint32_t line_ = 0;
  std::string joined_{};
};

// Notes where the program numbers of `block` begin; the diagnostic when it began before.
Diagnostics add_entry(Program& program, const Block& block, std::size_t index) {
  if (!block.program) return {};
  const auto [entry, fresh] = program.entries.emplace(*block.program, index);
  if (fresh) return {};
  Diagnostic diagnostic = error(fmt::format("program O{} is already on line {}", *block.program,
                                            program.blocks[entry->second].line),
                                "give each program of the file its own number");
  diagnostic.line = static_cast<int>(block.line);
  diagnostic.column = static_cast<int>(block.program_column);
  return {std::move(diagnostic)};
}

std::string value_text(const Block& block, ExpressionRange range) {
  return to_text(std::span(block.steps).subspan(range.first, range.count), block.names);
}

std::string word_text(const Block& block, const Word& word) {
  if (!word.expression.empty()) return word.letter + value_text(block, word.expression);
  std::string text = word.letter + decimal_text(word.number);
  if (word.decimal_point && text.find('.') == std::string::npos) text += '.';
  return text;
}

std::string setting_text(const Block& block, const Assignment& setting) {
  const std::string value = value_text(block, setting.value);
  if (setting.name) return fmt::format("#<{}>={}", block.names[*setting.name], value);
  return fmt::format("#[{}]={}", value_text(block, setting.index), value);
}

}  // namespace

Result<Program> parse_program(std::string_view text, std::string file, Dialect dialect) {
  Program program;
  program.dialect = dialect;
  program.file = std::move(file);
  Diagnostics failures;
  const auto fail = [&](Diagnostic diagnostic) {
    diagnostic.file = program.file;
    failures.push_back(std::move(diagnostic));
  };
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const BlockReader read = reader_of(dialect);
  LineSource source(text, dialect);
  while (!source.at_end() && failures.size() < kMaxSyntaxErrors) {
    const auto lines = source.next();
    auto block = read(lines.text, lines.first_line);
    if (!block) {
      fail(std::move(block).error().front());
      continue;
    }
    if (block->empty()) continue;
    block->line_starts = lines.line_starts;
    for (Diagnostic& twice : add_entry(program, *block, program.blocks.size()))
      fail(std::move(twice));
    program.blocks.push_back(*std::move(block));
  }
  if (failures.size() == kMaxSyntaxErrors && !source.at_end()) {
    fail(error(fmt::format("more than {} syntax errors; the rest of the file was not read",
                           kMaxSyntaxErrors - 1),
               "is this an NC program?"));
  }
  if (!failures.empty()) return failures;
  return program;
}

std::string to_text(const Block& block) {
  std::string text = block.tape_mark ? "%" : block.deletable ? "/" : "";
  const auto append = [&text](const std::string& part) {
    if (!text.empty() && text.back() != '/') text += ' ';
    text += part;
  };
  if (block.number) append(fmt::format("N{}", *block.number));
  if (block.program) append(fmt::format("O{}", *block.program));
  for (const Word& word : block.words) append(word_text(block, word));
  for (const Assignment& setting : block.assignments) append(setting_text(block, setting));
  for (const Comment& comment : block.comments) {
    append(fmt::format(fmt::runtime(comment.to_line_end ? ";{}" : "({})"), comment.text));
  }
  return text;
}

std::string to_text(const Program& program) {
  std::string text;
  for (const Block& block : program.blocks) text += to_text(block) + '\n';
  return text;
}

}  // namespace frustum::parser

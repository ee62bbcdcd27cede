#include "parser/program.hpp"

#include <fmt/format.h>

#include <span>

#include "parser/grammar.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

char line_end_of(std::string_view text) {
  return text.find('\n') == std::string_view::npos ? '\r' : '\n';
}

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
  const char line_end = line_end_of(text);
  for (std::uint32_t line = 1; !text.empty() && failures.size() < kMaxSyntaxErrors; ++line) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    std::string_view line_text = text.substr(0, end);
    if (line_text.ends_with('\r')) line_text.remove_suffix(1);
    auto block = parse_block(line_text, line);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!block) {
      fail(std::move(block).error().front());
      continue;
    }
    if (block->empty()) continue;
    for (Diagnostic& twice : add_entry(program, *block, program.blocks.size()))
      fail(std::move(twice));
    program.blocks.push_back(*std::move(block));
  }
  if (failures.size() == kMaxSyntaxErrors && !text.empty()) {
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

// A block while it is read: its text, what is read of it so far, and how its dialect writes
// expressions.
//
// Readers share one draft among the functions that read parts of a block.
// Units: none; values are as written.
// Errors: those of the scanner, which keeps the first one; finish() returns it
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/block.hpp"
#include "parser/reading/expression_reader.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

struct Code;
// Adds a word that has no number of its own: a code of the table.
void add_code(Block& block, const Code& code, std::uint32_t column);
// A letter with a plain number.
void add_number(Block& block, char letter, double number, std::uint32_t column,
                const char* spelled = nullptr);

struct BlockDraft {
  BlockDraft(std::string_view text, std::uint32_t line, const ExpressionRules& expressions)
      : in(text, line), rules(expressions) {
    block.line = line;
  }
  BlockDraft(const BlockDraft&) = delete;
  BlockDraft& operator=(const BlockDraft&) = delete;

  [[nodiscard]] ExpressionRange read_expression(ExpressionLevel level) {
    return ExpressionReader(in, block, rules).read(level);
  }
  // An expression becomes the word's value; a plain number needs no expression.
  void read_value(Word& word, ExpressionLevel level);
  // A label is all that there is so far; a statement may follow it.
  [[nodiscard]] bool labelled() const;
  // Whether anything but / and N is before.
  [[nodiscard]] bool begun() const;
  void begin_flow(FlowKind kind, std::uint32_t column);
  // name = expression; the = is read already.
  void begin_setting(const std::string& name, std::uint32_t column);
  void end_setting();
  std::uint32_t add_name(const std::string& name);
  void add_event(const char* event, std::uint32_t column, std::string text);
  // ; to the end of the line
  void read_comment();
  [[nodiscard]] Result<Block> finish() { return in.finish(std::move(block)); }

  LineScanner in;
  Block block{};
  const ExpressionRules& rules;
};

}  // namespace frustum::parser

#include "parser/reading/block_draft.hpp"

#include <utility>

#include "parser/dialects/code_table.hpp"

namespace frustum::parser {

void BlockDraft::read_value(Word& word, ExpressionLevel level) {
  word.expression = read_expression(level);
  if (word.expression.count != 1 || in.failed()) return;
  if (block.steps.back().operation != Operation::number) return;
  word.number = block.steps.back().number;
  word.expression = {};
  block.steps.pop_back();
}

bool BlockDraft::begun() const {
  return block.flow || !block.words.empty() || !block.assignments.empty() ||
         !block.comments.empty();
}

bool BlockDraft::labelled() const {
  return block.flow && block.flow->kind == FlowKind::label && block.words.empty() &&
         block.assignments.empty() && block.comments.empty();
}

void BlockDraft::begin_flow(FlowKind kind, std::uint32_t column) {
  FlowStatement statement;
  if (labelled()) {
    statement.block_label = std::move(block.flow->label);
    statement.block_label_column = block.flow->column;
  }
  block.flow = std::move(statement);
  block.flow->kind = kind;
  block.flow->column = column;
}

void BlockDraft::begin_setting(const std::string& name, std::uint32_t column) {
  Assignment setting;
  setting.column = column;
  setting.name = add_name(name);
  setting.value.first = static_cast<std::uint32_t>(block.steps.size());
  block.assignments.push_back(setting);
}

void BlockDraft::end_setting() {
  ExpressionRange& value = block.assignments.back().value;
  value.count = static_cast<std::uint32_t>(block.steps.size()) - value.first;
}

std::uint32_t BlockDraft::add_name(const std::string& name) {
  block.names.push_back(name);
  return static_cast<std::uint32_t>(block.names.size() - 1);
}

void BlockDraft::add_event(const char* event, std::uint32_t column, std::string text) {
  block.comments.push_back({column, false, std::move(text), event});
}

void BlockDraft::read_comment() {
  const std::uint32_t column = in.column();
  in.take(';');
  block.comments.push_back({column, true, in.text_to(), nullptr});
}

void add_code(Block& block, const Code& code, std::uint32_t column) {
  Word word;
  word.letter = kNamedWord;
  word.column = column;
  word.number = row_of(code);
  block.words.push_back(word);
}

void add_number(Block& block, char letter, double number, std::uint32_t column,
                const char* spelled) {
  Word word;
  word.letter = letter;
  word.column = column;
  word.number = number;
  word.spelled = spelled;
  block.words.push_back(word);
}

}  // namespace frustum::parser

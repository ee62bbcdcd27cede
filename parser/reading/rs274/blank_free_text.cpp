#include "parser/reading/rs274/blank_free_text.hpp"

#include <algorithm>

namespace frustum::parser {

BlankFreeText without_blanks(std::string_view line) {
  BlankFreeText free;
  bool in_comment = false;
  bool to_the_end = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!in_comment && !to_the_end && (c == ' ' || c == '\t' || c == '\r')) continue;
    to_the_end = to_the_end || (!in_comment && c == ';');
    if (!to_the_end && (c == '(' || c == ')')) in_comment = c == '(';
    free.text += c;
    free.columns.push_back(static_cast<std::uint32_t>(i) + 1);
  }
  free.columns.push_back(static_cast<std::uint32_t>(line.size()) + 1);
  return free;
}

void restore_columns(Block& block, const BlankFreeText& text) {
  const auto restore = [&](std::uint32_t& column) {
    if (column == 0) return;
    const std::size_t index = std::min<std::size_t>(column, text.columns.size()) - 1;
    column = text.columns[index];
  };
  restore(block.program_column);
  for (Word& word : block.words) restore(word.column);
  for (Assignment& setting : block.assignments) restore(setting.column);
  for (Comment& comment : block.comments) restore(comment.column);
  for (ExpressionStep& step : block.steps) restore(step.column);
  if (block.flow) restore(block.flow->column);
}

}  // namespace frustum::parser

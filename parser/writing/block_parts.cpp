#include "parser/writing/block_parts.hpp"

#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"

namespace frustum::parser {

void SpacedText::add(std::string_view part) {
  if (part.empty()) return;
  if (!text_.empty() && text_.back() != '/' && text_.back() != '\n') text_ += ' ';
  text_ += part;
}

std::span<const ExpressionStep> steps_of(const Block& block, ExpressionRange range) {
  return std::span(block.steps).subspan(range.first, range.count);
}

std::string range_text(const ExpressionSpelling& spelling, const Block& block,
                       ExpressionRange range, ExpressionLevel level) {
  return expression_text(spelling, steps_of(block, range), block.names, level);
}

std::string value_text(const ExpressionSpelling& spelling, const Block& block, const Word& word,
                       ExpressionLevel level) {
  return word.expression.empty() ? shortest_decimal(word.number)
                                 : range_text(spelling, block, word.expression, level);
}

std::string address_of(const Word& word) {
  return word.spelled != nullptr ? word.spelled : std::string(1, word.letter);
}

std::string_view named_word(const Word& word) {
  return word.letter == kNamedWord ? code_at(word.number).word : std::string_view{};
}

}  // namespace frustum::parser

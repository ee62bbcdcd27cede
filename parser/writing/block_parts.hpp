// What the writers of blocks and of motions share: parts of a block joined by blanks, and of the
// words of blocks their addresses, values and expressions.
//
// Units : as written
// Errors: none
#pragma once

#include <string>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/writing/expression_text.hpp"

namespace frustum::parser {

// Parts with a blank between them.
class SpacedText {
 public:
  SpacedText() = default;
  explicit SpacedText(std::string_view text) : text_(text) {}

  void add(std::string_view part);
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_{};
};

[[nodiscard]] std::span<const ExpressionStep> steps_of(const Block& block, ExpressionRange range);

[[nodiscard]] std::string range_text(const ExpressionSpelling& spelling, const Block& block,
                                     ExpressionRange range, ExpressionLevel level);

// The number of a word, or its expression when that binds at least as `level` does.
[[nodiscard]] std::string value_text(const ExpressionSpelling& spelling, const Block& block,
                                     const Word& word, ExpressionLevel level);
// What is before the number: the letter, "A3=".
[[nodiscard]] std::string address_of(const Word& word);
// Of a word without a number; empty for others.
[[nodiscard]] std::string_view named_word(const Word& word);

}  // namespace frustum::parser

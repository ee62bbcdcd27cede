// What the writers of all dialects share: parts of a block joined by blanks, its expressions, its
// named words.
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
  void add(std::string_view part);
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_{};
};

[[nodiscard]] std::span<const ExpressionStep> steps_of(const Block& block, ExpressionRange range);

[[nodiscard]] std::string range_text(const ExpressionSpelling& spelling, const Block& block,
                                     ExpressionRange range, ExpressionLevel level);

// Of a word without a number; empty for others.
[[nodiscard]] std::string_view named_word(const Word& word);

}  // namespace frustum::parser

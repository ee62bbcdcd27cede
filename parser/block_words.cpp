#include "parser/block_words.hpp"

#include <fmt/format.h>

#include <limits>

namespace frustum::parser {
namespace {

Diagnostic at(std::uint32_t line, std::uint32_t column, std::string message, std::string hint) {
  Diagnostic diagnostic = error(std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(line);
  diagnostic.column = static_cast<int>(column);
  return diagnostic;
}

Diagnostic unknown_code(std::uint32_t line, const Word& word, double number) {
  const std::string name = word.letter + decimal_text(number);
  if (const RefusedCode* refused = find_refused(word.letter, number)) {
    return at(line, word.column, name + " is not simulated", std::string(refused->remedy));
  }
  return at(line, word.column, "unknown word " + name, "known are " + known_codes(word.letter));
}

}  // namespace

char BlockWords::first_of(LetterSet letters) const {
  char first = 0;
  std::uint32_t first_column = std::numeric_limits<std::uint32_t>::max();
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!letters.has(letter) || !has(letter) || (*this)[letter].column >= first_column) continue;
    first = letter;
    first_column = (*this)[letter].column;
  }
  return first;
}

std::string BlockWords::text_of(char letter) const {
  return letter + decimal_text((*this)[letter].value);
}

Result<BlockWords> read_words(const Block& block, const Parameters& parameters) {
  const ExpressionContext context{block.steps, block.names, parameters};
  BlockWords words;
  for (const Word& word : block.words) {
    double number = word.number;
    if (!word.expression.empty()) {
      auto computed = evaluate(context, word.expression);
      if (!computed) {
        Diagnostic diagnostic = computed.error().front();
        diagnostic.line = static_cast<int>(block.line);
        return diagnostic;
      }
      number = *computed;
    }
    if (word.letter != 'G' && word.letter != 'M') {
      if (words.has(word.letter)) {
        return at(block.line, word.column, fmt::format("{} is given twice in a block", word.letter),
                  "leave one of them out, or write two blocks");
      }
      words.given_.add(word.letter);
      words.values_[BlockWords::slot(word.letter)] = {number, word.column, word.decimal_point};
      continue;
    }
    const Code* code = find_code(word.letter, number);
    if (code == nullptr) return unknown_code(block.line, word, number);
    if (code->event) words.events_.push_back({code, word.column});
    if (code->group == CodeGroup::event) continue;
    GivenCode& place = words.codes_[static_cast<std::size_t>(code->group)];
    if (place.code != nullptr) {
      return at(block.line, word.column,
                place.code == code ? fmt::format("{} is given twice in a block", code->name())
                                   : fmt::format("{} and {} contradict each other in a block",
                                                 place.code->name(), code->name()),
                "leave one of them out, or write two blocks");
    }
    place = {code, word.column};
  }
  return words;
}

}  // namespace frustum::parser

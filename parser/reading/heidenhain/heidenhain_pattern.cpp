// PATTERN DEF of Klartext: points at which CYCL CALL PAT calls the cycle.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "parser/dialects/code_table.hpp"
#include "parser/language/point_pattern.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kPatternHint =
    "write POS1 (X+10 Y+20 Z+0), ROW1, PAT1, FRAME1, CIRC1 or PITCHCIRC1";

// POS of POS1; null for other names.
const PatternElement* element_of(std::string_view name) {
  const std::string_view kind = name.substr(0, name.find_last_not_of("0123456789") + 1);
  const auto* known = std::ranges::find(kPatternElements, kind, &PatternElement::name);
  return known == kPatternElements.end() || kind.size() == name.size() ? nullptr : known;
}

// X+10, NUMQ5: the letter and the value of a word.
void read_word(BlockDraft& draft, const PatternElement& element, FramePart& part) {
  LineScanner& in = draft.in;
  const std::uint32_t column = in.column();
  const std::string written = in.letters();
  const auto* known = std::ranges::find_if(kPatternLetters, [&](const PatternLetter& letter) {
    return written.starts_with(letter.name);
  });
  const bool belongs = known != kPatternLetters.end() &&
                       (element.needed.find(known->letter) != std::string_view::npos ||
                        element.optional.find(known->letter) != std::string_view::npos);
  if (!belongs) {
    if (written.empty()) return in.fail_unexpected(std::string(kPatternHint));
    return in.fail("unknown-word"_id, column,
                   fmt::format("{} has no meaning in {}", written, part.name),
                   std::string(kPatternHint));
  }
  if (part.axes.find(known->letter) != std::string::npos) {
    return in.fail("word-twice"_id, column, fmt::format("{} is given twice", known->name),
                   "leave one of them out");
  }
  in.go_to(column + static_cast<std::uint32_t>(known->name.size()));
  part.axes += known->letter;
  part.values.push_back(draft.read_expression(ExpressionLevel::operand));
}

void read_element(BlockDraft& draft) {
  LineScanner& in = draft.in;
  const std::uint32_t column = in.column();
  FramePart part{in.name(), {}, {}};
  const PatternElement* element = element_of(part.name);
  if (element == nullptr) {
    if (part.name.empty()) return in.fail_unexpected(std::string(kPatternHint));
    return in.fail("unknown-word"_id, column, part.name + " is no pattern of points",
                   std::string(kPatternHint));
  }
  if (!in.take('(')) {
    return in.fail("bracket-missing"_id, in.column(), "the opening bracket is missing",
                   std::string(kPatternHint));
  }
  while (!in.failed() && in.peek() != ')' && !in.at_end()) {
    if (in.peek() == ';') {
      draft.read_comment();
      continue;
    }
    read_word(draft, *element, part);
  }
  if (!in.failed() && !in.take(')')) {
    return in.fail("bracket-not-closed"_id, column, "the bracket is not closed",
                   std::string(kPatternHint));
  }
  for (const char needed : element->needed) {
    if (in.failed() || part.axes.find(needed) != std::string::npos) continue;
    return in.fail("value-missing"_id, column,
                   fmt::format("{} has no {}", part.name, pattern_word(needed)),
                   std::string(kPatternHint));
  }
  draft.block.pattern.push_back(std::move(part));
}

}  // namespace

void read_heidenhain_pattern(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  if (!in.take_name("DEF")) {
    return in.fail("keyword-missing"_id, column, "PATTERN without DEF", std::string(kPatternHint));
  }
  add_code(draft.block, *find_code(Dialect::heidenhain, "PATTERN DEF"), column);
  while (!in.at_end()) {
    if (in.peek() == ';') {
      draft.read_comment();
    } else {
      read_element(draft);
    }
  }
  if (!in.failed() && draft.block.pattern.empty()) {
    in.fail("value-missing"_id, column, "PATTERN DEF has no points", std::string(kPatternHint));
  }
}

}  // namespace frustum::parser

#include "parser/language/block_text.hpp"

#include <fmt/format.h>

namespace frustum::parser {
namespace {

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

std::string to_text(const Block& block) {
  std::string text = block.tape_mark ? "%" : block.deletable ? "/" : "";
  if (block.delete_switch != 0) text += fmt::format("{} ", block.delete_switch);
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

std::string to_text(std::span<const Block> blocks) {
  std::string text;
  for (const Block& block : blocks) text += to_text(block) + '\n';
  return text;
}

}  // namespace frustum::parser

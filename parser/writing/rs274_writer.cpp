// Fanuc and LinuxCNC: words, settings, comments, and the statements of each.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/decimal.hpp"
#include "parser/dialects/expressions.hpp"
#include "parser/dialects/o_words.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/block_writer.hpp"
#include "parser/writing/number_text.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

class Rs274Block {
 public:
  Rs274Block(const Block& block, Dialect dialect)
      : block_(block),
        spelling_(expressions_of(dialect)),
        linuxcnc_(dialect == Dialect::linuxcnc) {}

  std::string operator()() {
    SpacedText text;
    if (block_.tape_mark) text.add("%" + tape_name());
    if (block_.deletable) text.add("/");
    if (block_.delete_switch != 0) text.add(fmt::format("{}", block_.delete_switch));
    if (block_.number) text.add(fmt::format("N{}", *block_.number));
    if (block_.flow)
      text.add(linuxcnc_ ? o_statement(*block_.flow) : macro_statement(*block_.flow));
    for (const Comment& comment : block_.comments) {
      if (comment.event != nullptr && !names_tape(comment)) text.add(output_statement(comment));
    }
    for (const Word& word : block_.words) text.add(word_text(word));
    for (const Assignment& setting : block_.assignments) text.add(setting_text(setting));
    // Behind the words: before them it would be an O word of LinuxCNC.
    if (block_.program) text.add(fmt::format("O{}", *block_.program));
    for (const Comment& comment : block_.comments) {
      if (comment.event != nullptr) continue;
      text.add(fmt::format(fmt::runtime(comment.to_line_end ? ";{}" : "({})"), comment.text));
    }
    return text.take();
  }

 private:
  [[nodiscard]] std::string value_text(ExpressionRange range, ExpressionLevel level) const {
    return range_text(spelling_, block_, range, level);
  }
  [[nodiscard]] std::string bracketed(ExpressionRange range) const {
    return "[" + value_text(range, disjunction) + "]";
  }
  // A number by itself would not be an expression.
  [[nodiscard]] std::string operand_text(ExpressionRange range) const {
    const auto steps = steps_of(block_, range);
    const bool number = steps.size() == 1 && steps.front().operation == Operation::number;
    return number ? bracketed(range) : value_text(range, operand);
  }
  [[nodiscard]] bool is_parameter(ExpressionRange range) const {
    const Operation last = steps_of(block_, range).back().operation;
    return last == Operation::parameter || last == Operation::named_parameter;
  }

  [[nodiscard]] std::string word_text(const Word& word) const {
    if (!word.expression.empty()) return address_of(word) + operand_text(word.expression);
    const std::string number = shortest_decimal(word.number);
    return address_of(word) + (word.decimal_point ? with_point(number) : number);
  }

  [[nodiscard]] std::string setting_text(const Assignment& setting) const {
    const std::string value = value_text(setting.value, disjunction);
    if (setting.name) return fmt::format("#<{}>={}", block_.names[*setting.name], value);
    const std::string index = value_text(setting.index, disjunction);
    const bool plain = index.find_first_not_of("0123456789") == std::string::npos;
    const bool bare = plain || is_parameter(setting.index);
    return fmt::format(fmt::runtime(bare ? "#{}={}" : "#[{}]={}"), index, value);
  }

  // o100, o<pocket>, o[#1].
  [[nodiscard]] std::string label_text(const FlowStatement& flow) const {
    if (!flow.label_value.empty()) return "o" + bracketed(flow.label_value);
    const bool digits = flow.label.size() <= 8 && flow.label.front() != '0' &&
                        flow.label.find_first_not_of("0123456789") == std::string::npos;
    return digits ? "o" + flow.label : fmt::format("o<{}>", flow.label);
  }

  static std::string_view o_word(const FlowStatement& flow) {
    const auto* word = std::ranges::find_if(kOWords, [&](const OWord& known) {
      return known.kind == flow.kind && (flow.kind != FlowKind::loop || known.turns == flow.turns);
    });
    return word != kOWords.end() ? word->name : std::string_view{};
  }

  [[nodiscard]] std::string o_statement(const FlowStatement& flow) const {
    if (flow.kind == FlowKind::program) return fmt::format("O<{}>", flow.label);
    std::string text = fmt::format("{} {}", label_text(flow), o_word(flow));
    if (!flow.condition.empty()) text += " " + bracketed(flow.condition);
    for (const ExpressionRange argument : flow.arguments) text += " " + bracketed(argument);
    return text;
  }

  [[nodiscard]] std::string jump_text(const FlowStatement& flow) const {
    if (flow.label_value.empty()) return "GOTO " + flow.label.substr(1);
    return "GOTO " + (is_parameter(flow.label_value) ? value_text(flow.label_value, operand)
                                                     : bracketed(flow.label_value));
  }

  [[nodiscard]] std::string macro_statement(const FlowStatement& flow) const {
    const std::string condition = flow.condition.empty() ? "" : bracketed(flow.condition) + " ";
    switch (flow.kind) {
      case FlowKind::loop:
        return (condition.empty() ? "" : "WHILE " + condition) + "DO" + flow.label;
      case FlowKind::end_loop:
        return "END" + flow.label;
      case FlowKind::only_if:
        return "IF " + condition + "THEN";
      default:
        return (condition.empty() ? "" : "IF " + condition) + jump_text(flow);
    }
  }

  static bool names_tape(const Comment& comment) { return std::string_view(comment.event) == "%"; }
  [[nodiscard]] std::string tape_name() const {
    for (const Comment& comment : block_.comments) {
      if (comment.event != nullptr && names_tape(comment)) return comment.text;
    }
    return {};
  }

  // DPRNT[X#1[53]], POPEN.
  static std::string output_statement(const Comment& comment) {
    const std::string_view name = comment.event;
    const bool has_text = name.ends_with("PRNT");
    return has_text ? fmt::format("{}[{}]", name, comment.text) : std::string(name);
  }

  const Block& block_;
  const ExpressionSpelling& spelling_;
  bool linuxcnc_;
};

}  // namespace

BlockWriter linuxcnc_writer() {
  return [](const Block& block) { return Rs274Block(block, Dialect::linuxcnc)(); };
}
BlockWriter fanuc_writer() {
  return [](const Block& block) { return Rs274Block(block, Dialect::fanuc)(); };
}

}  // namespace frustum::parser

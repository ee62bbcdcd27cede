// Fanuc and LinuxCNC: words, settings, comments, and the statements of each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "parser/writing/block_parts.hpp"
#include "parser/writing/block_writer.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

constexpr std::array kRs274Operators{
    BinaryOperator{disjunction, "AND", Operation::logical_and},
    BinaryOperator{disjunction, "OR", Operation::logical_or},
    BinaryOperator{disjunction, "XOR", Operation::logical_xor},
    BinaryOperator{comparison, "EQ", Operation::equal},
    BinaryOperator{comparison, "NE", Operation::not_equal},
    BinaryOperator{comparison, "GT", Operation::greater},
    BinaryOperator{comparison, "GE", Operation::greater_or_equal},
    BinaryOperator{comparison, "LT", Operation::less},
    BinaryOperator{comparison, "LE", Operation::less_or_equal},
    BinaryOperator{sum, "+", Operation::add},
    BinaryOperator{sum, "-", Operation::subtract},
    BinaryOperator{product, "*", Operation::multiply},
    BinaryOperator{product, "/", Operation::divide},
    BinaryOperator{product, "MOD", Operation::modulo},
    BinaryOperator{power, "**", Operation::power},
};
// Those that differ in Custom Macro.
constexpr std::array kMacroOperators{
    BinaryOperator{sum, "OR", Operation::bit_or},
    BinaryOperator{sum, "XOR", Operation::bit_xor},
    BinaryOperator{product, "AND", Operation::bit_and},
    BinaryOperator{product, "MOD", Operation::remainder},
};

std::vector<BinaryOperator> operators_of(Dialect dialect) {
  if (dialect == Dialect::linuxcnc) return {kRs274Operators.begin(), kRs274Operators.end()};
  std::vector<BinaryOperator> operators(kMacroOperators.begin(), kMacroOperators.end());
  const auto is_name_of_macro = [](const BinaryOperator& known) {
    return std::ranges::find(kMacroOperators, known.spelling, &BinaryOperator::spelling) !=
           kMacroOperators.end();
  };
  std::ranges::remove_copy_if(kRs274Operators, std::back_inserter(operators), is_name_of_macro);
  return operators;
}

std::vector<ExpressionFunction> functions_of(Dialect dialect) {
  std::vector<ExpressionFunction> functions;
  const auto add = [&](std::span<const FunctionName> names) {
    for (const FunctionName& function : names) {
      const int arguments = function.operation == Operation::arc_tangent ? 2 : 1;
      functions.push_back({function.name, function.operation, arguments});
    }
  };
  if (dialect == Dialect::fanuc) add(macro_function_names());
  add(function_names());
  return functions;
}

// With the rows that it points to.
struct Style {
  explicit Style(Dialect dialect)
      : operators(operators_of(dialect)), functions(functions_of(dialect)) {
    spelled = {.operators = operators,
               .functions = functions,
               .comparisons_chain = dialect == Dialect::linuxcnc,
               .signs_chain = false,
               .open = "[",
               .close = "]",
               .call_open = "[",
               .call_close = "]",
               .name_open = "#<",
               .name_close = ">",
               .index_open = "#[",
               .index_close = "]",
               .plain_index = "#",
               .argument_separator = "]/["};
  }
  Style(const Style&) = delete;
  Style& operator=(const Style&) = delete;

  std::vector<BinaryOperator> operators;
  std::vector<ExpressionFunction> functions;
  ExpressionStyle spelled{};
};

class Rs274Block {
 public:
  Rs274Block(const Block& block, Dialect dialect)
      : block_(block), style_(style_of(dialect)), linuxcnc_(dialect == Dialect::linuxcnc) {}

  std::string operator()() {
    SpacedText text;
    if (block_.tape_mark) text.add("%");
    if (block_.deletable) text.add("/");
    if (block_.delete_switch != 0) text.add(fmt::format("{}", block_.delete_switch));
    if (block_.number) text.add(fmt::format("N{}", *block_.number));
    if (block_.flow)
      text.add(linuxcnc_ ? o_statement(*block_.flow) : macro_statement(*block_.flow));
    for (const Comment& comment : block_.comments) {
      if (comment.event != nullptr) text.add(output_statement(comment));
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
  static const ExpressionStyle& style_of(Dialect dialect) {
    static const Style kLinuxcnc(Dialect::linuxcnc);
    static const Style kFanuc(Dialect::fanuc);
    return (dialect == Dialect::linuxcnc ? kLinuxcnc : kFanuc).spelled;
  }

  [[nodiscard]] std::string value_text(ExpressionRange range, ExpressionLevel level) const {
    return range_text(style_, block_, range, level);
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
    const std::string letter = word.spelled != nullptr ? word.spelled : std::string(1, word.letter);
    if (!word.expression.empty()) return letter + operand_text(word.expression);
    std::string text = letter + decimal_text(word.number);
    if (word.decimal_point && text.find('.') == std::string::npos) text += '.';
    return text;
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
    switch (flow.kind) {
      case FlowKind::subprogram:
        return "sub";
      case FlowKind::end_sub:
        return "endsub";
      case FlowKind::give_back:
        return "return";
      case FlowKind::call:
        return "call";
      case FlowKind::branch:
        return "if";
      case FlowKind::else_branch:
        return "elseif";
      case FlowKind::otherwise:
        return "else";
      case FlowKind::end_branch:
        return "endif";
      case FlowKind::loop:
        return flow.turns == Turns::counted     ? "repeat"
               : flow.turns == Turns::until_end ? "do"
                                                : "while";
      case FlowKind::end_loop:
        return "endwhile";  // that of a repeat may be spelled so, too
      case FlowKind::leave_loop:
        return "break";
      default:
        return "continue";
    }
  }

  [[nodiscard]] std::string o_statement(const FlowStatement& flow) const {
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

  // DPRNT[X#1[53]], POPEN.
  static std::string output_statement(const Comment& comment) {
    const std::string_view name = comment.event;
    const bool has_text = name.ends_with("PRNT");
    return has_text ? fmt::format("{}[{}]", name, comment.text) : std::string(name);
  }

  const Block& block_;
  const ExpressionStyle& style_;
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

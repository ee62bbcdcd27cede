// What the statements of Klartext share: values, Q parameters, the end of a statement.
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

constexpr std::array kOperators{
    BinaryOperator{sum, "+", Operation::add},
    BinaryOperator{sum, "-", Operation::subtract},
    BinaryOperator{product, "*", Operation::multiply},
    BinaryOperator{product, "/", Operation::divide},
    BinaryOperator{power, "^", Operation::power},
};
constexpr std::array kFunctions{
    ExpressionFunction{"SIN", Operation::sine},
    ExpressionFunction{"COS", Operation::cosine},
    ExpressionFunction{"TAN", Operation::tangent},
    ExpressionFunction{"ASIN", Operation::arc_sine},
    ExpressionFunction{"ACOS", Operation::arc_cosine},
    ExpressionFunction{"SQRT", Operation::square_root},
    ExpressionFunction{"ABS", Operation::absolute},
    ExpressionFunction{"INT", Operation::truncate},
    ExpressionFunction{"LN", Operation::logarithm},
    ExpressionFunction{"EXP", Operation::exponential},
};

bool read_variable(ExpressionReader& reader, const std::string& name, std::uint32_t column) {
  if (name == "PI") {
    reader.push_number(std::numbers::pi, column);
    return true;
  }
  if (name == "SQ") {
    reader.append(operand);
    reader.push_number(2.0, column);
    reader.push(Operation::power, column);
    return true;
  }
  if (name == "NEG") {
    reader.push_number(0.0, column);
    reader.append(operand);
    reader.push(Operation::subtract, column);
    return true;
  }
  if (!is_q_parameter(name)) return false;
  reader.push_name(name, column);
  return true;
}

constexpr ExpressionSpelling kSpelling{
    .operators = kOperators,
    .functions = kFunctions,
    .functions_have_brackets = false,
    .in_brackets = sum,
    .read_variable = read_variable,
    .no_operand = "this is no parameter",
    .no_operand_hint = "parameters are Q1, QL1 and QR1",
    .unknown_operand = "{} is no parameter and no function",
    .unknown_operand_hint =
        "parameters are Q1, QL1 and QR1; functions SIN COS TAN ASIN ACOS SQ SQRT LN EXP NEG ABS "
        "INT; and PI",
    .too_deep_hint = "compute a part before",
    .open_bracket_is_told = true,
};

}  // namespace

const ExpressionSpelling& heidenhain_expressions() { return kSpelling; }

bool is_q_parameter(std::string_view name) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string_view::npos ||
      name.find_first_not_of("0123456789", digits) != std::string_view::npos) {
    return false;
  }
  const std::string_view letters = name.substr(0, digits);
  return letters == "Q" || letters == "QL" || letters == "QR";
}

void add_value(BlockDraft& draft, char letter, std::string_view whose, std::uint32_t column,
               const char* spelled) {
  LineScanner& in = draft.in;
  const std::uint32_t place = in.column();
  const bool is_signed = in.take('-') || in.take('+');
  const bool parameter = in.peek() == 'Q';
  if (is_signed || !parameter) in.go_to(place);
  if (!parameter) {
    return add_number(draft.block, letter, in.signed_number(whose, column), column, spelled);
  }
  Word word;
  word.letter = letter;
  word.column = column;
  word.spelled = spelled;
  word.expression = draft.read_expression(operand);
  draft.block.words.push_back(word);
}

void note(BlockDraft& draft, const char* event, std::uint32_t column, std::string text) {
  draft.add_event(event, column, std::move(text));
  end_statement(draft);
}

void end_statement(BlockDraft& draft) {
  while (draft.in.peek() == ';') draft.read_comment();
  if (!draft.in.at_end()) draft.in.fail_unexpected("start a line for each statement");
}

void add_dwell(BlockDraft& draft, double seconds, std::uint32_t column) {
  add_code(draft.block, *find_code(Dialect::heidenhain, "DWELL"), column);
  add_number(draft.block, 'P', seconds, column, "TIME");
  end_statement(draft);
}

}  // namespace frustum::parser

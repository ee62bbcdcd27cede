// What the statements of Klartext share: values, Q parameters, the end of a statement.
#include <fmt/format.h>

#include <numbers>

#include "parser/dialects/code_table.hpp"
#include "parser/dialects/expressions.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

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
  if (name.empty() && reader.in().take('"')) {
    const std::string text = reader.in().text_to("\"");
    if (!reader.in().take('"')) {
      reader.in().fail("text-not-closed"_id, column, "the text is not closed", "close it with \"");
    }
    reader.push_name(text, column, Operation::text);
    return true;
  }
  if (is_text_parameter(name)) {
    reader.push_name(name, column);
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

}  // namespace

const ExpressionRules& heidenhain_expressions() {
  static const ExpressionMistake kNoParameter{"value-missing"_id, "this is no parameter",
                                              "parameters are Q1, QL1 and QR1"};
  static const ExpressionMistake kNotClosed{"bracket-not-closed"_id, "the bracket is not closed",
                                            "close it with )", true};
  static const ExpressionRules kRules{
      .spelling = expressions_of(Dialect::heidenhain),
      .read_variable = read_variable,
      .no_operand = kNoParameter,
      .no_operand_at_end = kNoParameter,
      .unknown_operand = {"unknown-word"_id, "{name} is no parameter and no function",
                          "parameters are Q1, QL1 and QR1; functions SIN COS TAN ASIN ACOS ATAN SQ "
                          "SQRT LN LOG EXP NEG ABS INT FRAC SGN; and PI",
                          true},
      .not_closed = kNotClosed,
      .not_closed_at_end = kNotClosed,
      .too_deep = {"brackets-too-deep"_id, "too many brackets within each other",
                   "compute a part before"},
  };
  return kRules;
}

bool is_q_parameter(std::string_view name) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string_view::npos ||
      name.find_first_not_of("0123456789", digits) != std::string_view::npos) {
    return false;
  }
  const std::string_view letters = name.substr(0, digits);
  return letters == "Q" || letters == "QL" || letters == "QR";
}

bool is_text_parameter(std::string_view name) {
  return name.size() > 2 && name.starts_with("QS") &&
         name.find_first_not_of("0123456789", 2) == std::string_view::npos;
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

#include "parser/reading/rs274/rs274_values.hpp"

#include <cctype>

#include "parser/dialects/expressions.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kExists = "EXISTS";
constexpr ExpressionMistake kNoParameter{"name-missing"_id, "# without a parameter",
                                         "write #1 or #<name>"};

// Up to the >.
std::string read_name(LineScanner& in) {
  const std::uint32_t column = in.column();
  std::string name = bare_name(in.bytes_to(">"));
  if (name.empty()) {
    in.fail("name-missing"_id, column, "the parameter has no name", "write #<name>");
  } else if (!in.take('>')) {
    in.fail("text-not-closed"_id, in.column(), "the parameter name is not closed", "write #<name>");
  }
  return name;
}

// What is after the # in that column.
void read_parameter(ExpressionReader& reader, std::uint32_t column, Dialect dialect,
                    Operation numbered = Operation::parameter,
                    Operation named = Operation::named_parameter) {
  if (!reader.enter(column)) return;
  const std::string name = read_parameter_index(reader, dialect);
  reader.leave();
  if (name.empty()) return reader.push(numbered, column);
  reader.push_name(name, column, named);
}

void read_existence(ExpressionReader& reader, std::uint32_t column, Dialect dialect) {
  LineScanner& in = reader.in();
  const std::uint32_t opening = reader.open_bracket(kExists);
  if (!reader.enter(opening)) return;
  const std::uint32_t parameter = in.column();
  if (!in.take('#')) return report(in, kNoParameter, parameter, {});
  read_parameter(reader, column, dialect, Operation::exists_number, Operation::exists);
  reader.close_bracket(opening, kExists);
  reader.leave();
}

template <Dialect dialect>
bool read_variable(ExpressionReader& reader, const std::string& /*name*/, std::uint32_t column) {
  LineScanner& in = reader.in();
  if (in.take('#')) {
    read_parameter(reader, column, dialect);
  } else if (in.take_bytes(kExists)) {
    read_existence(reader, column, dialect);
  } else {
    return false;
  }
  return true;
}

ExpressionRules rules_for(Dialect dialect) {
  const ExpressionMistake open_at_end{"bracket-not-closed"_id, "the bracket is not closed",
                                      "close it with ]", true};
  return {
      .spelling = expressions_of(dialect),
      .read_variable = dialect == Dialect::linuxcnc ? read_variable<Dialect::linuxcnc>
                                                    : read_variable<Dialect::fanuc>,
      .no_operand = {"value-missing"_id, "a number is missing before {found}",
                     "write a number, a parameter (#1), a function (SIN[30]) or an expression in "
                     "[ ]"},
      .no_operand_at_end = open_at_end,
      .no_call_bracket = {"bracket-missing"_id, "a function needs its argument in [ ]",
                          "write for example SIN[30]"},
      .no_second_argument = {"argument-count"_id, "{name} needs two values", "write {name}[x,y]"},
      .no_divisor = {"argument-count"_id, "{name} needs two values",
                     "write {name}[y]/[x] or {name}[y,x]"},
      .not_closed = {"unexpected-character"_id, "unexpected {found} in an expression",
                     "operators are + - * / ** MOD AND OR XOR and one EQ, NE, GT, GE, LT or LE; "
                     "close the expression with ]"},
      .not_closed_at_end = open_at_end,
      .too_deep = {"brackets-too-deep"_id, "more than 64 brackets within each other",
                   "compute a part of the expression into a parameter first", true},
  };
}

}  // namespace

std::string read_parameter_index(ExpressionReader& reader, Dialect dialect) {
  LineScanner& in = reader.in();
  const std::uint32_t column = in.column();
  if (in.take('<')) return read_name(in);
  if (const auto number = in.whole_number()) {
    reader.push_number(*number, column);
  } else if (in.peek() == '[') {
    reader.append_bracketed({});
  } else if (in.take('#')) {
    read_parameter(reader, column, dialect);
  } else if (dialect == Dialect::linuxcnc && std::isalpha(static_cast<unsigned char>(in.peek()))) {
    reader.append(ExpressionLevel::operand, column);
  } else {
    report(in, kNoParameter, column, {});
  }
  return {};
}

const ExpressionRules& rs274_expressions(Dialect dialect) {
  static const ExpressionRules kLinuxcnc = rules_for(Dialect::linuxcnc);
  static const ExpressionRules kFanuc = rules_for(Dialect::fanuc);
  return dialect == Dialect::linuxcnc ? kLinuxcnc : kFanuc;
}

}  // namespace frustum::parser

#include "parser/reading/expression_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum::parser {
namespace {

constexpr ExpressionLevel tighter(ExpressionLevel level) {
  return static_cast<ExpressionLevel>(static_cast<std::uint8_t>(level) + 1);
}

bool is_name(std::string_view spelling) {
  return spelling.front() >= 'A' && spelling.front() <= 'Z';
}

}  // namespace

ExpressionRange ExpressionReader::read(ExpressionLevel level) {
  ExpressionRange range{static_cast<std::uint32_t>(block_.steps.size()), 0};
  append(level);
  range.count = static_cast<std::uint32_t>(block_.steps.size()) - range.first;
  return range;
}

void ExpressionReader::append(ExpressionLevel level) {
  if (depth_ > kMaxExpressionDepth) {
    in_.fail("brackets-too-deep"_id, in_.column(), "too many brackets within each other",
             std::string(spelling_.too_deep_hint));
    return;
  }
  ++depth_;
  append_level(level);
  --depth_;
}

void ExpressionReader::append_level(ExpressionLevel level) {
  if (level == ExpressionLevel::operand) return append_operand();
  if (level == ExpressionLevel::comparison && !spelling_.negation.empty()) {
    const std::uint32_t column = in_.column();
    if (in_.take_name(spelling_.negation)) {
      append(level);
      push_number(0.0, column);
      return push(Operation::equal, column);
    }
  }
  append_level(tighter(level));
  while (!in_.failed()) {
    const std::uint32_t column = in_.column();
    const BinaryOperator* found = take_operator(level);
    if (found == nullptr) return;
    append_level(tighter(level));
    push(found->operation, column);
    if (level == ExpressionLevel::comparison) return;
  }
}

const BinaryOperator* ExpressionReader::take_operator(ExpressionLevel level) {
  const char next = in_.peek();
  for (const BinaryOperator& known : spelling_.operators) {
    if (known.level != level || known.spelling.front() != next) continue;
    if (is_name(known.spelling) ? in_.take_name(known.spelling) : in_.take_sign(known.spelling)) {
      return &known;
    }
  }
  const bool compares = level == ExpressionLevel::comparison;
  if (compares && !spelling_.single_equals_hint.empty() && in_.take('=')) {
    in_.fail_unexpected(std::string(spelling_.single_equals_hint));
  }
  return nullptr;
}

void ExpressionReader::append_operand() {
  const std::uint32_t column = in_.column();
  if (in_.take('-')) {
    append(ExpressionLevel::operand);
    if (in_.failed()) return;
    // A negative number is a number.
    ExpressionStep& last = block_.steps.back();
    if (last.operation != Operation::number) return push(Operation::negate, column);
    last.number = -last.number + 0.0;
    return;
  }
  if (in_.take('+')) return append(ExpressionLevel::operand);
  if (in_.take('(')) {
    append(spelling_.in_brackets);
    return close(column, "the expression");
  }
  if (const auto number = in_.number()) return push_number(number->value, column);
  const std::string name = in_.name();
  const auto function =
      std::find_if(spelling_.functions.begin(), spelling_.functions.end(),
                   [&](const ExpressionFunction& known) { return known.name == name; });
  if (function != spelling_.functions.end()) {
    append_function(*function);
    return push(function->operation, column);
  }
  if (in_.failed() || spelling_.read_variable(*this, name, column)) return;
  if (name.empty()) {
    in_.fail("value-missing"_id, column, std::string(spelling_.no_operand),
             std::string(spelling_.no_operand_hint));
  } else {
    in_.fail("unknown-word"_id, column, fmt::format(fmt::runtime(spelling_.unknown_operand), name),
             std::string(spelling_.unknown_operand_hint));
  }
}

void ExpressionReader::append_function(const ExpressionFunction& function) {
  if (!spelling_.functions_have_brackets) return append(ExpressionLevel::operand);
  if (!in_.take('(')) {
    in_.fail("bracket-missing"_id, in_.column(),
             fmt::format("{} needs its argument in ( )", function.name),
             "write for example SIN(30)");
    return;
  }
  append(ExpressionLevel::sum);
  for (int i = 1; i < function.arguments; ++i) {
    if (!in_.take(',')) {
      in_.fail("argument-count"_id, in_.column(), fmt::format("{} needs two values", function.name),
               fmt::format("write {}(y,x)", function.name));
    }
    append(ExpressionLevel::sum);
  }
  close_bracket(in_, function.name);
}

void ExpressionReader::close(std::uint32_t opening, std::string_view whose) {
  if (!spelling_.open_bracket_is_told) return close_bracket(in_, whose);
  if (!in_.failed() && !in_.take(')')) {
    in_.fail("bracket-not-closed"_id, opening, "the bracket is not closed", "close it with )");
  }
}

void ExpressionReader::push(Operation operation, std::uint32_t column) {
  if (!in_.failed()) block_.steps.push_back({operation, column, 0.0});
}
void ExpressionReader::push_number(double number, std::uint32_t column) {
  if (!in_.failed()) block_.steps.push_back({Operation::number, column, number});
}
void ExpressionReader::push_name(const std::string& name, std::uint32_t column) {
  block_.names.push_back(name);
  block_.steps.push_back(
      {Operation::named_parameter, column, static_cast<double>(block_.names.size() - 1)});
}

void close_bracket(LineScanner& in, std::string_view whose) {
  if (in.take(')')) return;
  if (in.at_end()) {
    in.fail("bracket-not-closed"_id, in.column(),
            fmt::format("the bracket of {} is not closed", whose), "close it with )");
  } else {
    in.fail_unexpected("close the bracket with )");
  }
}

}  // namespace frustum::parser

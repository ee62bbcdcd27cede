#include "parser/reading/expression_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

constexpr ExpressionLevel tighter(ExpressionLevel level) {
  return static_cast<ExpressionLevel>(static_cast<std::uint8_t>(level) + 1);
}
constexpr ExpressionLevel looser(ExpressionLevel level) {
  return static_cast<ExpressionLevel>(static_cast<std::uint8_t>(level) - 1);
}

bool is_name(std::string_view spelling) {
  return spelling.front() >= 'A' && spelling.front() <= 'Z';
}

}  // namespace

void report(LineScanner& in, const ExpressionMistake& mistake, std::uint32_t start,
            std::string_view name) {
  if (in.failed()) return;
  const auto worded = [&](std::string_view pattern) {
    return fmt::format(fmt::runtime(pattern), fmt::arg("name", name),
                       fmt::arg("found", in.next_shown()));
  };
  in.fail(mistake.id, mistake.at_start ? start : in.column(), worded(mistake.message),
          worded(mistake.hint));
}

ExpressionRange ExpressionReader::read(ExpressionLevel level) {
  ExpressionRange range{static_cast<std::uint32_t>(block_.steps.size()), 0};
  append_level(level);
  range.count = static_cast<std::uint32_t>(block_.steps.size()) - range.first;
  return range;
}

bool ExpressionReader::enter(std::uint32_t opening) {
  if (depth_ >= kMaxExpressionDepth) {
    report(in_, rules_.too_deep, opening, {});
    return false;
  }
  ++depth_;
  return true;
}

void ExpressionReader::append(ExpressionLevel level, std::uint32_t opening) {
  if (!enter(opening)) return;
  const std::uint32_t outer = std::exchange(opening_, opening);
  append_level(level);
  opening_ = outer;
  leave();
}

// After an operator only those follow that bind no tighter: the others belong to its right operand.
void ExpressionReader::append_level(ExpressionLevel level) {
  if (level == operand) return append_operand();
  ExpressionLevel most = power;
  const std::uint32_t start = in_.column();
  if (level <= comparison && !spelling_.negation.empty() && in_.take_name(spelling_.negation)) {
    append(comparison);
    push_number(0.0, start);
    push(Operation::equal, start);
    most = looser(comparison);
  } else {
    append_operand();
  }
  while (!in_.failed()) {
    const std::uint32_t column = in_.column();
    const BinaryOperator* found = take_operator(level, most);
    if (found == nullptr) return;
    append_level(tighter(found->level));
    push(found->operation, column);
    const bool once = found->level == comparison && !spelling_.comparisons_chain;
    most = once ? looser(comparison) : found->level;
  }
}

const BinaryOperator* ExpressionReader::take_operator(ExpressionLevel least, ExpressionLevel most) {
  const char next = in_.peek();
  for (const BinaryOperator& known : spelling_.operators) {
    if (known.spelling.front() != next || known.level < least || known.level > most) continue;
    if (take(known)) return &known;
  }
  const bool compares = least <= comparison && comparison <= most;
  if (compares && !rules_.single_equals_hint.empty() && in_.take('=')) {
    in_.fail_unexpected(std::string(rules_.single_equals_hint));
  }
  return nullptr;
}

bool ExpressionReader::take(const BinaryOperator& known) {
  if (spelling_.words_run_together) return in_.take_bytes(known.spelling);
  return is_name(known.spelling) ? in_.take_name(known.spelling) : in_.take_sign(known.spelling);
}

void ExpressionReader::append_operand() {
  const std::uint32_t column = in_.column();
  const bool negative = in_.take('-');
  if (!negative && !in_.take('+')) return append_unsigned();
  const bool apart = !spelling_.signs_chain && in_.peek() == spelling_.open.front();
  if (spelling_.signs_chain) {
    append(operand);
  } else {
    append_unsigned();
  }
  if (!negative || in_.failed()) return;
  // A negative number is a number.
  ExpressionStep& last = block_.steps.back();
  if (last.operation != Operation::number || apart) return push(Operation::negate, column);
  last.number = -last.number + 0.0;
}

void ExpressionReader::append_unsigned() {
  const std::uint32_t column = in_.column();
  if (in_.take(spelling_.open.front())) {
    append(spelling_.in_brackets, column);
    return close_bracket(column, "the expression");
  }
  if (const auto number = in_.number()) return push_number(number->value * power_of_ten(), column);
  const std::string name = spelling_.words_run_together ? std::string() : in_.name();
  if (append_function(name, column)) return;
  if (in_.failed() || rules_.read_variable(*this, name, column)) return;
  if (in_.failed()) return;
  if (!name.empty()) return report(in_, rules_.unknown_operand, column, name);
  found_nothing_ = depth_ == 0;
  const bool ends = depth_ > 0 && in_.at_end();
  report(in_, ends ? rules_.no_operand_at_end : rules_.no_operand, opening_, name);
}

double ExpressionReader::power_of_ten() {
  if (spelling_.exponent.empty()) return 1.0;
  const std::uint32_t start = in_.column();
  if (in_.take_bytes(spelling_.exponent)) {
    const bool negative = in_.take('-');
    if (!negative) in_.take('+');
    const auto digits = in_.digits();
    constexpr std::size_t kMostDigits = 3;
    int power = 0;
    if (!digits.empty() && digits.size() <= kMostDigits) {
      std::from_chars(digits.data(), digits.data() + digits.size(), power);
      return std::pow(10.0, negative ? -power : power);
    }
  }
  in_.go_to(start);
  return 1.0;
}

bool ExpressionReader::append_function(const std::string& name, std::uint32_t column) {
  const auto function = std::ranges::find_if(spelling_.functions, [&](const auto& known) {
    return spelling_.words_run_together ? in_.take_bytes(known.name) : known.name == name;
  });
  if (function == spelling_.functions.end()) return false;
  const bool of_one = append_arguments(*function);
  push(of_one ? Operation::arc_tangent : function->operation, column);
  return true;
}

bool ExpressionReader::append_arguments(const ExpressionFunction& function) {
  if (spelling_.call_open.empty()) {
    append(spelling_.argument);
    if (function.arguments != Arguments::one) push_number(1.0, in_.column());
    return function.arguments != Arguments::one;
  }
  const std::uint32_t opening = open_bracket(function.name);
  append(spelling_.argument, opening);
  if (function.arguments != Arguments::one) {
    if (in_.take(',')) {
      append(spelling_.argument, opening);
    } else if (function.arguments == Arguments::two) {
      report(in_, rules_.no_second_argument, opening, function.name);
    } else {
      close_bracket(opening, function.name);
      return append_divisor(function);
    }
  }
  close_bracket(opening, function.name);
  return false;
}

// Of ATAN[y]/[x].
bool ExpressionReader::append_divisor(const ExpressionFunction& function) {
  const std::uint32_t column = in_.column();
  if (in_.peek() != '/' && function.arguments == Arguments::one_or_divided) {
    push_number(1.0, column);
    return true;
  }
  if (in_.take('/')) {
    append_bracketed(function.name);
  } else {
    report(in_, rules_.no_divisor, column, function.name);
  }
  return false;
}

void ExpressionReader::append_element(const std::string& array, std::uint32_t column) {
  const std::uint32_t opening = in_.column();
  in_.take('[');
  std::uint32_t indices = 0;
  do {
    append(sum, opening);
    ++indices;
  } while (indices < kMaxIndices && in_.take(','));
  if (!in_.take(']')) {
    in_.fail("bracket-not-closed"_id, in_.column(), "the index is not closed", "close it with ]");
  }
  block_.names.push_back(array);
  const auto name = static_cast<std::uint32_t>(block_.names.size() - 1);
  if (!in_.failed())
    block_.steps.push_back({Operation::element, column, element_step(name, indices)});
}

void ExpressionReader::append_bracketed(std::string_view whose) {
  const std::uint32_t opening = open_bracket(whose);
  append(spelling_.argument, opening);
  close_bracket(opening, whose);
}

std::uint32_t ExpressionReader::open_bracket(std::string_view whose) {
  const std::uint32_t opening = in_.column();
  if (!in_.take(spelling_.call_open.front())) {
    report(in_, rules_.no_call_bracket, opening, whose);
  }
  return opening;
}

void ExpressionReader::close_bracket(std::uint32_t opening, std::string_view whose) {
  if (in_.take(spelling_.close.front())) return;
  report(in_, in_.at_end() ? rules_.not_closed_at_end : rules_.not_closed, opening, whose);
}

void ExpressionReader::push(Operation operation, std::uint32_t column) {
  if (!in_.failed()) block_.steps.push_back({operation, column, 0.0});
}
void ExpressionReader::push_number(double number, std::uint32_t column) {
  if (!in_.failed()) block_.steps.push_back({Operation::number, column, number});
}
void ExpressionReader::push_name(const std::string& name, std::uint32_t column,
                                 Operation operation) {
  block_.names.push_back(name);
  block_.steps.push_back({operation, column, static_cast<double>(block_.names.size() - 1)});
}

}  // namespace frustum::parser

#include "parser/writing/expression_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace frustum::parser {
namespace {

constexpr int kOperand = static_cast<int>(ExpressionLevel::operand);
// Parameters, functions and what is in brackets: they may follow a sign.
constexpr int kPrimary = kOperand + 1;

struct Piece {
  std::string text;
  int level = kPrimary;
};

class ExpressionWriter {
 public:
  ExpressionWriter(const ExpressionStyle& style, std::span<const std::string> names)
      : style_(style), names_(names) {}

  void add(const ExpressionStep& step) {
    switch (step.operation) {
      case Operation::number:
        return push(decimal_text(step.number), kOperand);
      case Operation::named_parameter:
        return push(named(step), kPrimary);
      case Operation::exists:
        return push(fmt::format("EXISTS{}{}{}", style_.call_open, named(step), style_.call_close),
                    kPrimary);
      case Operation::parameter:
        return push(numbered(pop()), kPrimary);
      case Operation::negate:
        return push("-" + at(pop(), style_.signs_chain ? kOperand : kPrimary), kOperand);
      default:
        return apply(step.operation);
    }
  }

  [[nodiscard]] std::string finish(int level) { return stack_.empty() ? "" : at(pop(), level); }

 private:
  void apply(Operation operation) {
    const auto does_it = [operation](const auto& row) { return row.operation == operation; };
    const auto function = std::ranges::find_if(style_.functions, does_it);
    if (function != style_.functions.end()) return call(*function);
    const auto found = std::ranges::find_if(style_.operators, does_it);
    if (found == style_.operators.end()) return;
    const int level = static_cast<int>(found->level);
    const bool chains = found->level != ExpressionLevel::comparison || style_.comparisons_chain;
    const bool name = std::isalpha(static_cast<unsigned char>(found->spelling.front())) != 0;
    const std::string right = at(pop(), level + 1);
    const std::string left = at(pop(), chains ? level : level + 1);
    push(fmt::format(fmt::runtime(name ? "{} {} {}" : "{}{}{}"), left, found->spelling, right),
         level);
  }

  void call(const ExpressionFunction& function) {
    std::string arguments;
    for (int i = 0; i < function.arguments; ++i) {
      const std::string argument = at(pop(), static_cast<int>(style_.argument));
      arguments = i == 0 ? argument : argument + std::string(style_.argument_separator) + arguments;
    }
    push(fmt::format("{}{}{}{}", function.name, style_.call_open, arguments, style_.call_close),
         kPrimary);
  }

  [[nodiscard]] std::string at(const Piece& piece, int level) const {
    if (piece.level >= level) return piece.text;
    return fmt::format("{}{}{}", style_.open, piece.text, style_.close);
  }
  [[nodiscard]] std::string named(const ExpressionStep& step) const {
    return fmt::format("{}{}{}", style_.name_open, names_[static_cast<std::size_t>(step.number)],
                       style_.name_close);
  }
  // #1, ##1, #[#1+1], R[R1+1].
  [[nodiscard]] std::string numbered(const Piece& index) const {
    const std::string_view sign = style_.plain_index;
    const bool digits = index.text.find_first_not_of("0123456789") == std::string::npos;
    const bool chain = index.level == kPrimary && index.text.starts_with(sign);
    if (!sign.empty() && (digits || chain)) return std::string(sign) + index.text;
    return fmt::format("{}{}{}", style_.index_open, index.text, style_.index_close);
  }

  void push(std::string text, int level) { stack_.push_back({std::move(text), level}); }
  Piece pop() {
    Piece top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  const ExpressionStyle& style_;
  std::span<const std::string> names_;
  std::vector<Piece> stack_;
};

}  // namespace

std::string expression_text(const ExpressionStyle& style, std::span<const ExpressionStep> steps,
                            std::span<const std::string> names, ExpressionLevel level) {
  ExpressionWriter writer(style, names);
  for (const ExpressionStep& step : steps) writer.add(step);
  return writer.finish(static_cast<int>(level));
}

}  // namespace frustum::parser

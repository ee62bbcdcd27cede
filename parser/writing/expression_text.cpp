#include "parser/writing/expression_text.hpp"
#include "core/decimal.hpp"

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
  ExpressionWriter(const ExpressionSpelling& spelling, std::span<const std::string> names)
      : spelling_(spelling), names_(names) {}

  void add(const ExpressionStep& step) {
    switch (step.operation) {
      case Operation::number:
        return push(shortest_decimal(step.number), kOperand);
      case Operation::named_parameter:
        return push(named(step), kPrimary);
      case Operation::exists:
        return push(
            fmt::format("EXISTS{}{}{}", spelling_.call_open, named(step), spelling_.call_close),
            kPrimary);
      case Operation::exists_number:
        return push(
            fmt::format("EXISTS{}{}{}", spelling_.call_open, numbered(pop()), spelling_.call_close),
            kPrimary);
      case Operation::text:
        return push('"' + names_[static_cast<std::size_t>(step.number)] + '"', kPrimary);
      case Operation::element:
        return push(element(step), kPrimary);
      case Operation::parameter:
        return push(numbered(pop()), kPrimary);
      case Operation::negate:
        return push("-" + at(pop(), spelling_.signs_chain ? kOperand : kPrimary), kOperand);
      default:
        return apply(step.operation);
    }
  }

  [[nodiscard]] std::string finish(int level) { return stack_.empty() ? "" : at(pop(), level); }

 private:
  void apply(Operation operation) {
    const auto does_it = [operation](const auto& row) { return row.operation == operation; };
    const auto found = std::ranges::find_if(spelling_.operators, does_it);
    if (found == spelling_.operators.end()) {
      const auto function = std::ranges::find_if(spelling_.functions, does_it);
      if (function != spelling_.functions.end()) call(*function);
      return;
    }
    const int level = static_cast<int>(found->level);
    const bool chains = found->level != ExpressionLevel::comparison || spelling_.comparisons_chain;
    const bool name = std::isalpha(static_cast<unsigned char>(found->spelling.front())) != 0;
    const std::string right = at(pop(), level + 1);
    const std::string left = at(pop(), chains ? level : level + 1);
    push(fmt::format(fmt::runtime(name ? "{} {} {}" : "{}{}{}"), left, found->spelling, right),
         level);
  }

  void call(const ExpressionFunction& function) {
    const auto argument = [this] { return at(pop(), static_cast<int>(spelling_.argument)); };
    std::string arguments = argument();
    // Of one, where functions have no brackets: the other is 1.
    const bool of_one = function.arguments == Arguments::beside_one ||
                        (function.arguments != Arguments::one && spelling_.call_open.empty());
    if (of_one) arguments = argument();
    if (function.arguments != Arguments::one && !of_one) {
      const bool divided = function.arguments != Arguments::two;
      const std::string first = argument();
      arguments = divided ? fmt::format("{}{}/{}{}", first, spelling_.call_close,
                                        spelling_.call_open, arguments)
                          : fmt::format("{},{}", first, arguments);
    }
    const std::string_view open = spelling_.call_open.empty() ? " " : spelling_.call_open;
    // A / behind ATAN[y] would begin its divisor.
    const bool may_be_divided = function.arguments == Arguments::beside_one;
    push(fmt::format("{}{}{}{}", function.name, open, arguments, spelling_.call_close),
         may_be_divided ? static_cast<int>(ExpressionLevel::sum) : kPrimary);
  }

  [[nodiscard]] std::string at(const Piece& piece, int level) const {
    if (piece.level >= level) return piece.text;
    return fmt::format("{}{}{}", spelling_.open, piece.text, spelling_.close);
  }
  [[nodiscard]] std::string named(const ExpressionStep& step) const {
    return fmt::format("{}{}{}", spelling_.name_open, names_[static_cast<std::size_t>(step.number)],
                       spelling_.name_close);
  }
  // A[1,2]
  std::string element(const ExpressionStep& step) {
    std::string indices;
    for (std::uint32_t i = 0; i < indices_of_element(step); ++i) {
      indices = at(pop(), static_cast<int>(ExpressionLevel::sum)) + (i == 0 ? "" : ",") + indices;
    }
    return fmt::format("{}[{}]", names_[name_of_element(step)], indices);
  }
  // #1, ##1, #[#1+1], R[R1+1].
  [[nodiscard]] std::string numbered(const Piece& index) const {
    const std::string_view sign = spelling_.plain_index;
    const bool digits = index.text.find_first_not_of("0123456789") == std::string::npos;
    const bool chain = index.level == kPrimary && index.text.starts_with(sign);
    if (!sign.empty() && (digits || chain)) return std::string(sign) + index.text;
    return fmt::format("{}{}{}", spelling_.index_open, index.text, spelling_.index_close);
  }

  void push(std::string text, int level) { stack_.push_back({std::move(text), level}); }
  Piece pop() {
    Piece top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  const ExpressionSpelling& spelling_;
  std::span<const std::string> names_;
  std::vector<Piece> stack_;
};

}  // namespace

std::string expression_text(const ExpressionSpelling& spelling,
                            std::span<const ExpressionStep> steps,
                            std::span<const std::string> names, ExpressionLevel level) {
  ExpressionWriter writer(spelling, names);
  for (const ExpressionStep& step : steps) writer.add(step);
  return writer.finish(static_cast<int>(level));
}

}  // namespace frustum::parser

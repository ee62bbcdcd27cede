// Reads infix expressions, in the spelling of one dialect, as the postfix steps of a block.
//
// All dialects are read here, by the tables of parser/dialects/expressions.hpp; a dialect adds a
// function that reads its variables and how it words what is wrong.
// Units: none; values are as written.
// Errors: an operand or bracket that is missing, brackets too deep; at the scanner, with their
//         columns
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "parser/language/block.hpp"
#include "parser/language/expression_spelling.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

class ExpressionReader;

// What is reported of a mistake. {name} is what was read, {found} the character that follows.
struct ExpressionMistake {
  DiagnosticId id{};
  std::string_view message{};
  std::string_view hint{};
  bool at_start = false;  // where the bracket or the name begins; else where reading stopped
};

struct ExpressionRules {
  const ExpressionSpelling& spelling;
  // Puts the variable of that name after the steps; false when it is none. Where words run together
  // no name is read before.
  bool (*read_variable)(ExpressionReader& reader, const std::string& name, std::uint32_t column);
  ExpressionMistake no_operand{};
  ExpressionMistake no_operand_at_end{};  // in brackets
  ExpressionMistake unknown_operand{};
  ExpressionMistake no_call_bracket{};
  ExpressionMistake no_second_argument{};
  ExpressionMistake no_divisor{};  // of ATAN[y]/[x]
  ExpressionMistake not_closed{};
  ExpressionMistake not_closed_at_end{};
  ExpressionMistake too_deep{};
  std::string_view single_equals_hint{};  // where = does not compare
};

class ExpressionReader {
 public:
  ExpressionReader(LineScanner& in, Block& block, const ExpressionRules& rules)
      : in_(in), block_(block), rules_(rules), spelling_(rules.spelling) {}

  // An expression whose operators bind at least as `level` does.
  [[nodiscard]] ExpressionRange read(ExpressionLevel level);
  // Whether there was nothing to read, outside of brackets: the reader's caller may know better
  // what is missing.
  [[nodiscard]] bool found_nothing() const { return found_nothing_; }

  // For variables: what they are made of.
  [[nodiscard]] LineScanner& in() { return in_; }
  // An expression within something that opened at that column, or here.
  void append(ExpressionLevel level, std::uint32_t opening = 0);
  // The indices of that array in [ ], then its element.
  void append_element(const std::string& array, std::uint32_t column);
  // An argument in its brackets.
  void append_bracketed(std::string_view whose);
  // The column of the bracket.
  std::uint32_t open_bracket(std::string_view whose);
  void close_bracket(std::uint32_t opening, std::string_view whose);
  // One more thing that is open; false, and reported, when there are too many.
  bool enter(std::uint32_t opening);
  void leave() { --depth_; }
  void push(Operation operation, std::uint32_t column);
  void push_number(double number, std::uint32_t column);
  void push_name(const std::string& name, std::uint32_t column,
                 Operation operation = Operation::named_parameter);

 private:
  void append_level(ExpressionLevel level);
  void append_operand();
  void append_unsigned();
  [[nodiscard]] double power_of_ten();  // of a number that is read
  bool append_function(const std::string& name, std::uint32_t column);
  // Both: whether they are one and a 1 beside it, of the arc tangent.
  bool append_arguments(const ExpressionFunction& function);
  bool append_divisor(const ExpressionFunction& function);
  // One whose level is within these, both included.
  [[nodiscard]] const BinaryOperator* take_operator(ExpressionLevel least, ExpressionLevel most);
  bool take(const BinaryOperator& known);

  LineScanner& in_;
  Block& block_;
  const ExpressionRules& rules_;
  const ExpressionSpelling& spelling_;
  int depth_ = 0;
  std::uint32_t opening_ = 0;  // of the innermost bracket
  bool found_nothing_ = false;
};

// Reports it at the scanner.
void report(LineScanner& in, const ExpressionMistake& mistake, std::uint32_t start,
            std::string_view name);

}  // namespace frustum::parser

#include "parser/dialects/expressions.hpp"

#include <algorithm>
#include <array>

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

template <typename Row, std::size_t N, std::size_t M>
constexpr std::array<Row, N + M> joined(const std::array<Row, N>& own,
                                        const std::array<Row, M>& shared) {
  std::array<Row, N + M> rows{};
  std::copy(shared.begin(), shared.end(), std::copy(own.begin(), own.end(), rows.begin()));
  return rows;
}

// Of all dialects.
constexpr std::array kArithmetic{
    BinaryOperator{sum, "+", Operation::add},
    BinaryOperator{sum, "-", Operation::subtract},
    BinaryOperator{product, "*", Operation::multiply},
    BinaryOperator{product, "/", Operation::divide},
};
constexpr std::array kFunctions{
    ExpressionFunction{"SIN", Operation::sine},
    ExpressionFunction{"COS", Operation::cosine},
    ExpressionFunction{"TAN", Operation::tangent},
    ExpressionFunction{"ASIN", Operation::arc_sine},
    ExpressionFunction{"ACOS", Operation::arc_cosine},
    ExpressionFunction{"SQRT", Operation::square_root},
    ExpressionFunction{"ABS", Operation::absolute},
    ExpressionFunction{"LN", Operation::logarithm},
    ExpressionFunction{"EXP", Operation::exponential},
};

// Of Fanuc and LinuxCNC.
constexpr auto kRs274Arithmetic = joined(
    std::array{
        BinaryOperator{power, "**", Operation::power},
        BinaryOperator{comparison, "EQ", Operation::equal},
        BinaryOperator{comparison, "NE", Operation::not_equal},
        BinaryOperator{comparison, "GT", Operation::greater},
        BinaryOperator{comparison, "GE", Operation::greater_or_equal},
        BinaryOperator{comparison, "LT", Operation::less},
        BinaryOperator{comparison, "LE", Operation::less_or_equal},
    },
    kArithmetic);

constexpr auto kLinuxcncOperators = joined(
    std::array{
        BinaryOperator{disjunction, "AND", Operation::logical_and},
        BinaryOperator{disjunction, "OR", Operation::logical_or},
        BinaryOperator{disjunction, "XOR", Operation::logical_xor},
        BinaryOperator{product, "MOD", Operation::modulo},
    },
    kRs274Arithmetic);
constexpr auto kLinuxcncFunctions = joined(
    std::array{
        ExpressionFunction{"ATAN", Operation::arc_tangent, Arguments::divided},
        ExpressionFunction{"ROUND", Operation::round},
        ExpressionFunction{"FIX", Operation::fix},
        ExpressionFunction{"FUP", Operation::fup},
    },
    kFunctions);

// Custom Macro: AND, OR and XOR combine bits.
constexpr auto kFanucOperators = joined(
    std::array{
        BinaryOperator{sum, "OR", Operation::bit_or},
        BinaryOperator{sum, "XOR", Operation::bit_xor},
        BinaryOperator{product, "AND", Operation::bit_and},
        BinaryOperator{product, "MOD", Operation::remainder},
    },
    kRs274Arithmetic);
constexpr auto kFanucFunctions = joined(
    std::array{
        ExpressionFunction{"ATAN", Operation::arc_tangent_from_zero, Arguments::one_or_divided},
        ExpressionFunction{"ATAN", Operation::arc_tangent, Arguments::beside_one},
        ExpressionFunction{"ASIN", Operation::arc_sine_from_zero},
        ExpressionFunction{"ROUND", Operation::round},
        ExpressionFunction{"FIX", Operation::truncate},
        ExpressionFunction{"FUP", Operation::round_away},
        ExpressionFunction{"BIN", Operation::from_bcd},
        ExpressionFunction{"BCD", Operation::to_bcd},
        ExpressionFunction{"ADP", Operation::as_it_is},
        ExpressionFunction{"POW", Operation::power, Arguments::two},
    },
    kFunctions);

constexpr auto kSinumerikOperators = joined(
    std::array{
        BinaryOperator{sum, "<<", Operation::join},
        BinaryOperator{sum, "B_AND", Operation::bit_and},
        BinaryOperator{sum, "B_OR", Operation::bit_or},
        BinaryOperator{sum, "B_XOR", Operation::bit_xor},
        BinaryOperator{disjunction, "OR", Operation::logical_or},
        BinaryOperator{disjunction, "XOR", Operation::logical_xor},
        BinaryOperator{conjunction, "AND", Operation::logical_and},
        BinaryOperator{comparison, "==", Operation::equal},
        BinaryOperator{comparison, "<>", Operation::not_equal},
        BinaryOperator{comparison, "<=", Operation::less_or_equal},
        BinaryOperator{comparison, "<", Operation::less},
        BinaryOperator{comparison, ">=", Operation::greater_or_equal},
        BinaryOperator{comparison, ">", Operation::greater},
        BinaryOperator{product, "MOD", Operation::modulo},
        BinaryOperator{product, "DIV", Operation::whole_quotient},
    },
    kArithmetic);
constexpr auto kSinumerikFunctions = joined(
    std::array{
        ExpressionFunction{"ATAN2", Operation::arc_tangent, Arguments::two},
        ExpressionFunction{"ROUND", Operation::round},
        ExpressionFunction{"TRUNC", Operation::truncate},
        ExpressionFunction{"ROUNDUP", Operation::fup},
        ExpressionFunction{"MINVAL", Operation::least, Arguments::two},
        ExpressionFunction{"MAXVAL", Operation::greatest, Arguments::two},
        ExpressionFunction{"POT", Operation::square},
    },
    kFunctions);

constexpr auto kHeidenhainOperators =
    joined(std::array{BinaryOperator{power, "^", Operation::power},
                      BinaryOperator{sum, "||", Operation::join},
                      BinaryOperator{product, "%", Operation::modulo}},
           kArithmetic);
constexpr auto kHeidenhainFunctions = joined(
    std::array{ExpressionFunction{"INT", Operation::truncate},
               ExpressionFunction{"FRAC", Operation::fraction},
               ExpressionFunction{"SGN", Operation::sign},
               ExpressionFunction{"LOG", Operation::common_logarithm},
               ExpressionFunction{"ATAN", Operation::arc_tangent, Arguments::one_or_divided}},
    kFunctions);

constexpr ExpressionSpelling kLinuxcnc{.operators = kLinuxcncOperators,
                                       .functions = kLinuxcncFunctions,
                                       .words_run_together = true,
                                       .comparisons_chain = true,
                                       .signs_chain = false,
                                       .open = "[",
                                       .close = "]",
                                       .call_open = "[",
                                       .call_close = "]",
                                       .argument = disjunction,
                                       .name_open = "#<",
                                       .name_close = ">",
                                       .index_open = "#[",
                                       .index_close = "]",
                                       .plain_index = "#"};

constexpr ExpressionSpelling fanuc_expressions() {
  ExpressionSpelling spelling = kLinuxcnc;
  spelling.operators = kFanucOperators;
  spelling.functions = kFanucFunctions;
  spelling.comparisons_chain = false;
  return spelling;
}
constexpr ExpressionSpelling kFanuc = fanuc_expressions();

constexpr ExpressionSpelling kSinumerik{.operators = kSinumerikOperators,
                                        .functions = kSinumerikFunctions,
                                        .negation = "NOT",
                                        .index_open = "R[",
                                        .index_close = "]",
                                        .exponent = "EX"};

constexpr ExpressionSpelling kHeidenhain{.operators = kHeidenhainOperators,
                                         .functions = kHeidenhainFunctions,
                                         .call_open = {},
                                         .call_close = {},
                                         .in_brackets = sum,
                                         .argument = operand};

constexpr ExpressionSpelling kNone{};

}  // namespace

const ExpressionSpelling& expressions_of(Dialect dialect) {
  static constexpr std::array kSpellings{&kFanuc, &kLinuxcnc, &kSinumerik, &kHeidenhain, &kNone};
  static_assert(kSpellings.size() == kDialects.size());
  return *kSpellings[static_cast<std::size_t>(dialect)];
}

}  // namespace frustum::parser

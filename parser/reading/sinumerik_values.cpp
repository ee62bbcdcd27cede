#include "parser/reading/sinumerik_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

constexpr std::array kOperators{
    BinaryOperator{disjunction, "OR", Operation::logical_or},
    BinaryOperator{disjunction, "XOR", Operation::logical_xor},
    BinaryOperator{conjunction, "AND", Operation::logical_and},
    BinaryOperator{comparison, "==", Operation::equal},
    BinaryOperator{comparison, "<>", Operation::not_equal},
    BinaryOperator{comparison, "<=", Operation::less_or_equal},
    BinaryOperator{comparison, "<", Operation::less},
    BinaryOperator{comparison, ">=", Operation::greater_or_equal},
    BinaryOperator{comparison, ">", Operation::greater},
    BinaryOperator{sum, "+", Operation::add},
    BinaryOperator{sum, "-", Operation::subtract},
    BinaryOperator{product, "*", Operation::multiply},
    BinaryOperator{product, "/", Operation::divide},
    BinaryOperator{product, "MOD", Operation::modulo},
};
constexpr std::array kFunctions{
    ExpressionFunction{"SIN", Operation::sine},
    ExpressionFunction{"COS", Operation::cosine},
    ExpressionFunction{"TAN", Operation::tangent},
    ExpressionFunction{"ASIN", Operation::arc_sine},
    ExpressionFunction{"ACOS", Operation::arc_cosine},
    ExpressionFunction{"ATAN2", Operation::arc_tangent, 2},
    ExpressionFunction{"SQRT", Operation::square_root},
    ExpressionFunction{"ABS", Operation::absolute},
    ExpressionFunction{"ROUND", Operation::round},
    ExpressionFunction{"LN", Operation::logarithm},
    ExpressionFunction{"EXP", Operation::exponential},
};

bool read_variable(ExpressionReader& reader, const std::string& name, std::uint32_t column) {
  if (!is_r_parameter(name)) return false;
  reader.push_name(name, column);
  return true;
}

constexpr ExpressionSpelling kSpelling{
    .operators = kOperators,
    .functions = kFunctions,
    .negation = "NOT",
    .read_variable = read_variable,
    .no_operand = "a number is missing",
    .no_operand_hint = "write a number, an R parameter, a function or an expression in ( )",
    .unknown_operand = "unknown operand {}",
    .unknown_operand_hint =
        "known are R parameters and SIN COS TAN ASIN ACOS ATAN2 SQRT ABS ROUND LN EXP",
    .too_deep_hint = "compute a part into an R parameter",
    .single_equals_hint = "compare by ==",
};

struct MeasureName {
  std::string_view name;
  Measure measure;
};
constexpr std::array kMeasures{MeasureName{"AC", Measure::absolute},
                               MeasureName{"IC", Measure::incremental},
                               MeasureName{"DC", Measure::shortest}};

}  // namespace

const ExpressionSpelling& sinumerik_expressions() { return kSpelling; }

bool is_r_parameter(std::string_view name) {
  return name.size() > 1 && name.front() == 'R' &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

void read_sinumerik_value(BlockDraft& draft, Word& word, const std::string& name) {
  LineScanner& in = draft.in;
  const bool rotary = name == "A" || name == "B" || name == "C";
  const std::string found = in.next_name();
  const std::uint32_t column = in.column();
  if (found == "ACP" || found == "ACN") {
    in.fail(column, found + " is not simulated", "use DC(), the shorter way, or AC()");
    return;
  }
  if (in.peek() == '"') {
    in.fail(column, fmt::format("{} has a name instead of a number", name),
            "tools go by their numbers here: T1");
    return;
  }
  const auto* measure = std::find_if(kMeasures.begin(), kMeasures.end(),
                                     [&](const MeasureName& m) { return m.name == found; });
  const bool measured = measure != kMeasures.end();
  if (measured) {
    (void)in.name();
    word.measure = measure->measure;
    if (word.measure == Measure::shortest && !rotary) {
      in.fail(column, "DC() is for rotary axes", "write AC() or the plain value");
      return;
    }
    if (!in.take('(')) {
      in.fail(in.column(), found + " needs its value in ( )", "write X=" + found + "(1)");
      return;
    }
  }
  draft.read_value(word, sum);
  if (measured) close_bracket(in, found);
}

}  // namespace frustum::parser

#include "parser/reading/sinumerik/sinumerik_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "parser/dialects/expressions.hpp"
#include "parser/dialects/sinumerik_words.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

struct Constant {
  std::string_view name;
  double value;
};
constexpr std::array kConstants{Constant{"TRUE", 1.0}, Constant{"FALSE", 0.0}};

// What the control knows itself: those of an axis, as $P_EP[X], and those of the program.
constexpr std::array<std::string_view, 2> kOfAnAxis{"P_EP", "AA_IW"};
constexpr std::array<std::string_view, 4> kOfTheProgram{"P_TOOLNO", "P_F", "P_S", "P_SDIR"};

void read_system_variable(ExpressionReader& reader, std::uint32_t column) {
  LineScanner& in = reader.in();
  std::string name = in.name();
  const auto is_in = [&](const auto& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (name == "PI") return reader.push_number(std::numbers::pi, column);
  const bool of_an_axis = is_in(kOfAnAxis);
  if (!of_an_axis && !is_in(kOfTheProgram)) {
    in.fail("not-supported"_id, column, fmt::format("${} is not simulated", name),
            "known are $P_EP[X] $AA_IW[X] $P_TOOLNO $P_F $P_S $P_SDIR $PI; else give a number");
    return;
  }
  if (of_an_axis) {
    const bool opens = in.take('[');
    const std::uint32_t place = in.column();
    const std::string axis = in.name();
    if (!opens || axis.size() != 1 || std::string_view("XYZABC").find(axis) == std::string::npos ||
        !in.take(']')) {
      in.fail("value-missing"_id, place, fmt::format("${} without its axis", name),
              fmt::format("write ${}[X]", name));
      return;
    }
    name += "[" + axis + "]";
  }
  reader.push_name("$" + name, column);
}

void close_index(LineScanner& in) {
  if (!in.take(']'))
    in.fail("bracket-not-closed"_id, in.column(), "the index is not closed", "close it with ]");
}

bool read_variable(ExpressionReader& reader, const std::string& name, std::uint32_t column) {
  LineScanner& in = reader.in();
  if (name.empty()) {
    if (!in.take('$')) return false;
    read_system_variable(reader, column);
    return true;
  }
  const auto* constant = std::find_if(kConstants.begin(), kConstants.end(),
                                      [&](const Constant& c) { return c.name == name; });
  if (constant != kConstants.end()) {
    reader.push_number(constant->value, column);
    return true;
  }
  if (name == "R" && in.take('[')) {
    reader.append(sum);
    close_index(in);
    reader.push(Operation::parameter, column);
    return true;
  }
  if (!is_r_parameter(name) && !is_variable(name)) return false;
  if (in.peek() == '(') {
    in.fail(
        "unknown-word"_id, column, fmt::format("unknown function {}", name),
        "known are SIN COS TAN ASIN ACOS ATAN2 SQRT ABS ROUND ROUNDUP TRUNC LN EXP MINVAL MAXVAL");
    return true;
  }
  if (in.peek() == '[') {
    in.fail("not-supported"_id, column, fmt::format("{} is an array", name),
            "use R parameters: R[10+R1]");
    return true;
  }
  reader.push_name(name, column);
  return true;
}

}  // namespace

const ExpressionRules& sinumerik_expressions() {
  static const ExpressionMistake kNoNumber{
      "value-missing"_id, "a number is missing",
      "write a number, an R parameter, a function or an expression in ( )"};
  static const ExpressionRules kRules{
      .spelling = expressions_of(Dialect::sinumerik),
      .read_variable = read_variable,
      .no_operand = kNoNumber,
      .no_operand_at_end = kNoNumber,
      .unknown_operand = {"unknown-word"_id, "unknown operand {name}",
                          "known are R parameters, variables of DEF and functions such as SIN(30)",
                          true},
      .no_call_bracket = {"bracket-missing"_id, "{name} needs its argument in ( )",
                          "write for example SIN(30)"},
      .no_second_argument = {"argument-count"_id, "{name} needs two values", "write {name}(y,x)"},
      .not_closed = {"unexpected-character"_id, "unexpected {found}", "close the bracket with )"},
      .not_closed_at_end = {"bracket-not-closed"_id, "the bracket of {name} is not closed",
                            "close it with )"},
      .too_deep = {"brackets-too-deep"_id, "too many brackets within each other",
                   "compute a part into an R parameter"},
      .single_equals_hint = "compare by ==",
  };
  return kRules;
}

void close_bracket(LineScanner& in, std::string_view whose) {
  if (in.take(')')) return;
  const ExpressionRules& rules = sinumerik_expressions();
  report(in, in.at_end() ? rules.not_closed_at_end : rules.not_closed, in.column(), whose);
}

bool is_r_parameter(std::string_view name) {
  return name.size() > 1 && name.front() == 'R' &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool is_variable(std::string_view name) {
  const auto is_letter = [](char c) { return c == '_' || (c >= 'A' && c <= 'Z'); };
  return name.size() > 1 && is_letter(name[0]) && is_letter(name[1]);
}

void read_sinumerik_value(BlockDraft& draft, Word& word, const std::string& name) {
  LineScanner& in = draft.in;
  const bool rotary = name == "A" || name == "B" || name == "C";
  const std::string found = in.next_name();
  const std::uint32_t column = in.column();
  if (in.peek() == '"') {
    in.fail("not-supported"_id, column, fmt::format("{} has a name instead of a number", name),
            "tools go by their numbers here: T1");
    return;
  }
  const auto* measure = std::ranges::find(kMeasureNames, found, &MeasureName::name);
  const bool measured = measure != kMeasureNames.end();
  if (measured) {
    (void)in.name();
    word.measure = measure->measure;
    if (word.measure >= Measure::shortest && !rotary) {
      in.fail("word-misplaced"_id, column, found + "() is for rotary axes",
              "write AC() or the plain value");
      return;
    }
    if (!in.take('(')) {
      in.fail("bracket-missing"_id, in.column(), found + " needs its value in ( )",
              "write X=" + found + "(1)");
      return;
    }
  }
  draft.read_value(word, sum);
  if (measured) close_bracket(in, found);
}

}  // namespace frustum::parser

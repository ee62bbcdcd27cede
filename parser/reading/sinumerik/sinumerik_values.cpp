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

// Of an axis, as $P_EP[X].
constexpr std::array<std::string_view, 2> kOfAnAxis{"P_EP", "AA_IW"};

void close_index(LineScanner& in) {
  if (!in.take(']'))
    in.fail("bracket-not-closed"_id, in.column(), "the index is not closed", "close it with ]");
}

// The name of a system variable; with its indices where they are names of axes and the like.
void read_system_variable(ExpressionReader& reader, std::uint32_t column) {
  LineScanner& in = reader.in();
  const std::string name = in.name();
  if (name == "PI") return reader.push_number(std::numbers::pi, column);
  if (name.empty()) {
    in.fail("name-missing"_id, column, "$ without a name", "write for example $P_EP[X]");
    return;
  }
  const std::uint32_t place = in.column();
  const std::string indices = read_index_names(in);
  if (!indices.empty()) return reader.push_name("$" + name + indices, column);
  if (std::find(kOfAnAxis.begin(), kOfAnAxis.end(), name) != kOfAnAxis.end()) {
    in.fail("value-missing"_id, place, fmt::format("${} without its axis", name),
            fmt::format("write ${}[X]", name));
    return;
  }
  if (in.peek() != '[') return reader.push_name("$" + name, column);
  reader.append_element("$" + name, column);
}

// 'HFF', 'B101': after the first quote.
void read_bits(ExpressionReader& reader, std::uint32_t column) {
  LineScanner& in = reader.in();
  const std::string written = in.name();
  const bool hexadecimal = written.starts_with('H');
  double value = 0.0;
  bool right = written.size() > 1 && (hexadecimal || written.starts_with('B'));
  for (std::size_t i = 1; right && i < written.size(); ++i) {
    const auto digit = static_cast<double>(std::string_view("0123456789ABCDEF").find(written[i]));
    const double base = hexadecimal ? 16.0 : 2.0;
    right = digit < base && value < 4294967296.0;
    value = value * base + digit;
  }
  if (!right || !in.take('\'')) {
    in.fail("value-missing"_id, column, "no number within the quotes", "write 'H1F' or 'B101'");
    return;
  }
  reader.push_number(value, column);
}

// A value without a name; false when there is none.
bool read_sign_value(ExpressionReader& reader, std::uint32_t column) {
  LineScanner& in = reader.in();
  if (in.take('$')) {
    read_system_variable(reader, column);
    return true;
  }
  if (in.take('\'')) {
    read_bits(reader, column);
    return true;
  }
  if (in.take('"')) {
    const std::string text = in.text_to("\"");
    if (!in.take('"')) {
      in.fail("text-not-closed"_id, column, "the text is not closed", "close it with \"");
    }
    reader.push_name(text, column, Operation::text);
    return true;
  }
  // <<R1 is the text of a number.
  if (!in.take_sign("<<")) return false;
  reader.push_name("", column, Operation::text);
  reader.append(operand);
  reader.push(Operation::join, column);
  return true;
}

// The least value, the greatest value and what is held between them.
void read_bound(ExpressionReader& reader, std::uint32_t column) {
  LineScanner& in = reader.in();
  in.take('(');
  reader.append(sum);
  const bool two = in.take(',');
  reader.append(sum);
  const bool three = two && in.take(',');
  if (!three) {
    in.fail("argument-count"_id, column, "BOUND needs three values",
            "write BOUND(least,most,value)");
    return;
  }
  reader.append(sum);
  reader.push(Operation::least, column);
  reader.push(Operation::greatest, column);
  close_bracket(in, "BOUND");
}

bool read_variable(ExpressionReader& reader, const std::string& name, std::uint32_t column) {
  LineScanner& in = reader.in();
  if (name.empty()) return read_sign_value(reader, column);
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
  if (name == "BOUND" && in.peek() == '(') {
    read_bound(reader, column);
    return true;
  }
  if (name.size() == 1 && in.peek() == '[') {
    reader.append_element(name, column);
    return true;
  }
  if (is_axis_name(name)) {
    reader.push_name(name, column, Operation::text);
    return true;
  }
  if (!is_r_parameter(name) && !is_variable(name)) return false;
  if (in.peek() == '(') {
    in.fail("unknown-word"_id, column, fmt::format("unknown function {}", name),
            "known are SIN COS TAN ASIN ACOS ATAN2 SQRT POT ABS ROUND ROUNDUP TRUNC LN EXP MINVAL "
            "MAXVAL "
            "BOUND");
    return true;
  }
  if (in.peek() == '[') {
    reader.append_element(name, column);
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

std::string read_index_names(LineScanner& in) {
  const std::uint32_t start = in.column();
  if (!in.take('[')) return {};
  std::string text = "[";
  bool names = false;
  do {
    const std::string name = in.name();
    names = names || (!name.empty() && !is_r_parameter(name));
    const std::string index = name.empty() ? std::string(in.digits()) : name;
    if (index.empty()) break;
    text += (text.size() > 1 ? "," : "") + index;
  } while (in.take(','));
  if (names && in.take(']')) return text + ']';
  in.go_to(start);
  return {};
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

bool is_axis_name(std::string_view name) {
  constexpr std::string_view kNames = "XYZABCUVW";
  return name.size() == 1 && kNames.find(name.front()) != std::string_view::npos;
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

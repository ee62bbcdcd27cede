#include "parser/reading/cldata/cldata_record.hpp"
#include "core/counted.hpp"
#include "core/decimal.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace frustum::parser {
namespace {

constexpr std::array<const char*, 8> kTexts{"PARTNO", "PPRINT", "INSERT", "REMARK",
                                            "LETTER", "DISPLY", "PPFUN",  "TPRINT"};

double read_number(LineScanner& in, std::uint32_t column) {
  const bool negative = in.take('-');
  if (!negative) in.take('+');
  const auto found = in.number();
  if (!found) {
    in.fail("argument-count"_id, column, "an argument is missing",
            "write the arguments after /, separated by ,");
    return 0.0;
  }
  double value = found->value;
  // D is the exponent of a double in Fortran.
  if (const char mark = in.peek_byte(); mark == 'E' || mark == 'D') {
    in.take(mark);
    value *= std::pow(10.0, in.signed_number("the exponent", column));
    if (!std::isfinite(value))
      in.fail("number-too-large"_id, column, "the number is too large", "check its exponent");
  }
  return (negative ? -value : value) + 0.0;
}

// 1STPECK: digits that letters follow which are no exponent.
std::string word_with_digits(LineScanner& in) {
  const std::uint32_t column = in.column();
  std::string word(in.digits());
  const char next = in.peek_byte();
  if (!word.empty() && next >= 'A' && next <= 'Z' && next != 'E' && next != 'D') {
    return word + in.name();
  }
  in.go_to(column);
  return {};
}

}  // namespace

std::span<const char* const> cldata_text_words() { return kTexts; }

const char* cldata_text_word(std::string_view record) {
  for (const char* text : kTexts) {
    if (record.starts_with(text)) return text;
  }
  return nullptr;
}

std::string CldataRecord::text_from(std::size_t first) const {
  std::string text;
  for (std::size_t i = first; i < arguments.size(); ++i) {
    if (!text.empty()) text += ',';
    text += arguments[i].is_number() ? shortest_decimal(arguments[i].number) : arguments[i].word;
  }
  return text;
}

std::vector<CldataArgument> read_cldata_arguments(LineScanner& in) {
  std::vector<CldataArgument> arguments;
  if (in.at_end() || in.peek() == '$') return arguments;
  do {
    CldataArgument argument{in.column(), in.name(), 0.0};
    if (argument.is_number()) argument.word = word_with_digits(in);
    if (argument.is_number()) argument.number = read_number(in, argument.column);
    arguments.push_back(std::move(argument));
  } while (in.take(','));
  return arguments;
}

bool are_cldata_numbers(LineScanner& in, const CldataRecord& record,
                        std::initializer_list<std::size_t> counts, const char* remedy) {
  for (const CldataArgument& argument : record.arguments) {
    if (argument.is_number()) continue;
    in.fail("unknown-word"_id, argument.column,
            fmt::format("{} has no meaning in {}", argument.word, record.word), remedy);
    return false;
  }
  for (const std::size_t count : counts) {
    if (record.arguments.size() == count) return true;
  }
  in.fail("argument-count"_id, record.column,
          fmt::format("{} with {}", record.word, counted(record.arguments.size(), "number")),
          remedy);
  return false;
}

}  // namespace frustum::parser

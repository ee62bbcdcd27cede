#include "parser/reading/heidenhain/plain_line.hpp"

#include <charconv>

#include "parser/dialects/code_table.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/plain_number.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kWordsOfAPlainLine = 8;
// M words below this have no operands, but for two that are two words.
constexpr double kPlainM = 89.0;
constexpr double kSpindleAndCoolant[] = {13.0, 14.0};

struct Rows {
  double line = row_of(*find_code(Dialect::heidenhain, "L"));
  double rapid_line = row_of(*find_code(Dialect::heidenhain, "L FMAX"));
  double no_radius = row_of(*find_code(Dialect::heidenhain, "R0"));
};
const Rows& rows() {
  static const Rows kRows;
  return kRows;
}

bool is_decimal(char c) { return c >= '0' && c <= '9'; }
bool is_alphanumeric(char c) {
  return is_decimal(c) || (upper(c) >= 'A' && upper(c) <= 'Z') || c == '_';
}

class PlainLineReader {
 public:
  PlainLineReader(std::string_view text, Block& block) : text_(text), block_(block) {}

  bool read() {
    block_.number.reset();
    block_.words.clear();
    block_.words.reserve(kWordsOfAPlainLine);
    if (!read_number_of_line()) return false;
    if (upper(peek()) != 'L') return false;
    add(kNamedWord, place_, rows().line);
    ++place_;
    // A blank ends the word, which else is another one: LN, LP, LBL.
    if (at_place() != ' ') return false;
    while (peek() != 0) {
      if (!read_element()) return false;
    }
    return place_ == text_.size();
  }

 private:
  bool read_number_of_line() {
    if (!is_decimal(peek())) return true;
    constexpr std::size_t kMostDigits = 8;
    const std::size_t start = place_;
    while (is_decimal(at_place())) ++place_;
    if (place_ - start > kMostDigits) return false;
    std::uint32_t number = 0;
    std::from_chars(text_.data() + start, text_.data() + place_, number);
    block_.number = number;
    return true;
  }

  bool read_element() {
    const std::size_t column = place_;
    const char letter = upper(text_[place_++]);
    switch (letter) {
      case 'X':
      case 'Y':
      case 'Z':
      case 'A':
      case 'B':
      case 'C':
        return read_value(letter, column);
      case 'R':
        if (at_place() != '0' || is_alphanumeric(behind()) || behind() == '.' || behind() == ',') {
          return false;
        }
        ++place_;
        add(kNamedWord, column, rows().no_radius);
        return true;
      case 'F':
        if (upper(at_place()) == 'M') return read_rapid();
        return is_decimal(at_place()) && read_value(letter, column);
      case 'M':
        return is_decimal(at_place()) && read_value(letter, column) && is_plain_m();
      default:
        return false;
    }
  }

  bool read_rapid() {
    for (const char expected : {'M', 'A', 'X'}) {
      if (upper(at_place()) != expected) return false;
      ++place_;
    }
    if (is_alphanumeric(at_place())) return false;
    block_.words.front().number = rows().rapid_line;
    return true;
  }

  bool read_value(char letter, std::size_t column) {
    const bool negative = at_place() == '-';
    if (negative || at_place() == '+') ++place_;
    const auto number = read_plain_number(text_.data() + place_, text_.data() + text_.size());
    if (!number) return false;
    place_ = static_cast<std::size_t>(number->end - text_.data());
    if (at_place() == ',') return false;
    // The sum turns -0 into 0.
    add(letter, column, (negative ? -number->value : number->value) + 0.0);
    return true;
  }

  [[nodiscard]] bool is_plain_m() const {
    const double m = block_.words.back().number;
    return m < kPlainM && m != kSpindleAndCoolant[0] && m != kSpindleAndCoolant[1];
  }

  void add(char letter, std::size_t place, double number) {
    Word& word = block_.words.emplace_back();
    word.letter = letter;
    word.column = static_cast<std::uint32_t>(place + 1);
    word.number = number;
  }

  [[nodiscard]] char at_place() const { return place_ < text_.size() ? text_[place_] : '\0'; }
  [[nodiscard]] char behind() const { return place_ + 1 < text_.size() ? text_[place_ + 1] : '\0'; }
  // The next character that is not blank; 0 at the end.
  char peek() {
    while (at_place() == ' ' || at_place() == '\t' || at_place() == '\r') ++place_;
    return at_place();
  }

  std::string_view text_;
  Block& block_;
  std::size_t place_ = 0;
};

}  // namespace

bool read_plain_line(Block& block, std::string_view text, std::uint32_t line) {
  block.line = line;
  return PlainLineReader(text, block).read();
}

}  // namespace frustum::parser

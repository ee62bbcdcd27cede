#include "tests/parser/random_text.hpp"

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "core/decimal.hpp"
#include "parser/language/expression.hpp"
#include "tests/parser/random_languages.hpp"
#include "tests/parser/random_program.hpp"

namespace frustum::parser {
namespace {

class TextWriter {
 public:
  TextWriter(Dice& dice, const Language& language) : dice_(dice), language_(language) {}

  std::string line() {
    if (dice_.chance(0.05)) return filled(any(language_.alone)) + "\n";
    std::string text = filled(any(language_.line_starts));
    text += filled(any(language_.lines));
    return text + filled(any(language_.line_ends)) + "\n";
  }

 private:
  std::string_view any(std::span<const std::string_view> choices) {
    return choices[dice_.below(choices.size())];
  }

  std::string filled(std::string_view form) {
    std::string text;
    for (std::size_t i = 0; i < form.size(); ++i) {
      if (form[i] == '`') {
        text += hole(form[++i]);
      } else {
        text += form[i];
      }
    }
    return text;
  }

  std::string hole(char kind) {
    switch (kind) {
      case 'n':
        return shortest_decimal(dice_.number());
      case 'u':
        return shortest_decimal(std::abs(dice_.number()));
      case 's':
        return signed_number();
      case 'd':
        return std::to_string(dice_.below(100'000));
      case '1':
        return std::to_string(1 + dice_.below(3));
      case 'p':
        return std::string(any(language_.parameters));
      case 'q':
        return dice_.chance(0.5) ? signed_number() : (dice_.chance(0.5) ? "+" : "-") + hole('p');
      case 'e':
        return expression(3);
      case 'c':
        return condition(2);
      case 'l':
        return std::string(any(language_.labels));
      case 't':
        return words_of_text();
      default:
        return words();
    }
  }

  std::string signed_number() {
    const std::string number = hole('n');
    return number.front() == '-' ? number : "+" + number;
  }
  std::string in_brackets(const std::string& text) {
    return std::string(language_.open) + text + std::string(language_.close);
  }

  std::string expression(int depth) {
    if (depth == 0 || dice_.chance(0.3)) {
      return dice_.chance(0.5) ? hole('p') : hole('u');
    }
    switch (dice_.below(5)) {
      case 0:
        return "-" + operand(depth - 1);
      case 1:
        return filled(any(language_.functions)) + operand(depth - 1) +
               std::string(language_.function_end);
      case 2:
        return operand(depth - 1);
      default:
        return operand(depth - 1) + std::string(any(language_.operators)) + operand(depth - 1);
    }
  }
  std::string operand(int depth) {
    if (depth == 0) return dice_.chance(0.5) ? hole('p') : hole('u');
    return in_brackets(expression(depth));
  }
  std::string condition(int depth) {
    if (depth == 0 || dice_.chance(0.4)) {
      return operand(2) + std::string(any(language_.comparisons)) + operand(2);
    }
    if (!language_.negation.empty() && dice_.chance(0.2)) {
      return std::string(language_.negation) + in_brackets(condition(depth - 1));
    }
    return in_brackets(condition(depth - 1)) + std::string(any(language_.connectives)) +
           in_brackets(condition(depth - 1));
  }

  std::string words_of_text() {
    constexpr std::array<std::string_view, 6> kParts{"tool", "10 mm", "Fr\xC3\xA4ser",
                                                     "a,b",  "=",     "/"};
    std::string text = "T";
    for (std::size_t i = dice_.below(4); i > 0; --i) {
      text += " ";
      text += any(kParts);
    }
    return text;
  }
  std::string words() {
    std::string text;
    for (std::size_t i = dice_.below(6) + 1; i > 0; --i) text += filled(any(language_.words)) + " ";
    return text;
  }

  Dice& dice_;
  const Language& language_;
};

}  // namespace

std::string random_text(std::uint64_t seed, Dialect dialect) {
  Dice dice(seed);
  const Language& language = language_of(dialect);
  TextWriter writer(dice, language);
  std::string text(language.head);
  for (std::size_t i = dice.below(12) + 1; i > 0; --i) text += writer.line();
  return text;
}

}  // namespace frustum::parser

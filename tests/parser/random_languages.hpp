// What random programs are made of, a table a dialect.
//
// Lines have holes, filled by chance:
//   `n number   `u without a sign   `s with one        `d digits      `1 a digit above zero
//   `p parameter   `q one with a sign, or a signed number   `e expression   `c condition   `l label
//   `t words of text   `x words of the dialect in any number
// Units : none
// Errors: none
#pragma once

#include <string_view>
#include <vector>

#include "parser/dialect.hpp"

namespace frustum::parser {

struct Language {
  std::string_view head{};  // of the program
  std::vector<std::string_view> lines;
  std::vector<std::string_view> alone{};  // lines without start and end
  std::vector<std::string_view> words{};
  std::vector<std::string_view> line_starts{""};
  std::vector<std::string_view> line_ends{""};
  std::vector<std::string_view> parameters{};
  std::vector<std::string_view> labels{};
  std::vector<std::string_view> operators{};
  std::vector<std::string_view> functions{};  // up to their argument
  std::string_view open = "(";
  std::string_view close = ")";
  std::string_view function_end = ")";
  std::vector<std::string_view> comparisons{};
  std::vector<std::string_view> connectives{};
  std::string_view negation{};  // NOT
};

[[nodiscard]] const Language& language_of(Dialect dialect);

}  // namespace frustum::parser

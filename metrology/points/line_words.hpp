// A line of a text file as words: fields of a CSV, or what blanks separate.
//
// Model    : a line with a semicolon outside quotes is separated by semicolons, one with a comma by
//            commas, else by blanks and tabs; a # outside quotes begins a comment
// Units    : none
// Shape    : one line
// Errors   : none
// Accuracy : as std::from_chars
// Source   : RFC 4180 (quotes)
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustum::metrology {

struct Word {
  std::string text;
  int column;  // 1-based
};

// The line without its comment, and the comment.
[[nodiscard]] std::pair<std::string_view, std::string_view> split_comment(std::string_view line);

[[nodiscard]] std::vector<Word> words_of(std::string_view line);
// The fields between semicolons or tabs; those between tabs may be empty.
[[nodiscard]] std::vector<Word> words_between(std::string_view line, char separator);

// All of the text, with a sign or without.
[[nodiscard]] std::optional<double> number_in(std::string_view text);
// The same of digits with one comma among them: "-1,5" and "1,5e3". An integer has none.
[[nodiscard]] std::optional<double> comma_number_in(std::string_view text);

// The first number of the line that is written with a decimal comma, where semicolons or blanks
// separate: "1,5" in "1,5;2;3" and in "1,5 2 3".
[[nodiscard]] std::optional<Word> decimal_comma(std::string_view line);

}  // namespace frustum::metrology

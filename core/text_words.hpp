// The words of a text one after another, each with its line, and the number that a word is.
//
// Units: none. Errors: none; past the end words are empty.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace frustum {

class TextWords {
 public:
  explicit TextWords(std::string_view text, int line = 1) : text_(text), line_(line) {}

  // Empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }
  // Of this line only; empty at its end.
  std::string_view next_in_line() {
    while (at_ < text_.size() && is_space(text_[at_]) && text_[at_] != '\n') ++at_;
    return at_ < text_.size() && text_[at_] == '\n' ? std::string_view{} : next();
  }
  // What is left of this line, with its blanks.
  std::string_view rest_of_line() {
    const std::size_t from = at_;
    skip_line();
    return text_.substr(from, at_ - from);
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  [[nodiscard]] int line() const { return line_; }      // of the last word
  [[nodiscard]] std::size_t at() const { return at_; }  // the first byte after the last word

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_;
};

// Nothing unless the whole word is a number of that type that is within its range.
template <typename Number>
[[nodiscard]] std::optional<Number> number_in_word(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

[[nodiscard]] inline std::optional<double> finite_number_in_word(std::string_view word) {
  const auto value = number_in_word<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace frustum

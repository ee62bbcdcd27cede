#include "metrology/points/line_words.hpp"

#include <charconv>

namespace frustum::metrology {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// The first of `wanted` that is not within quotes.
std::size_t find_unquoted(std::string_view line, char wanted) {
  bool quoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (line[at] == wanted && !quoted) return at;
  }
  return std::string_view::npos;
}

// A field in quotes, from the first of them; a doubled quote represents one.
std::string unquoted(std::string_view line, std::size_t& at) {
  std::string text;
  for (++at; at < line.size(); ++at) {
    if (line[at] == '"' && (at + 1 >= line.size() || line[at + 1] != '"')) {
      ++at;
      break;
    }
    if (line[at] == '"') ++at;
    text += line[at];
  }
  return text;
}

// At ' ' tabs separate too, and several are one.
std::vector<Word> split(std::string_view line, char separator) {
  std::vector<Word> words;
  const bool by_blanks = separator == ' ';
  const auto ends_word = [&](char c) { return by_blanks ? is_blank(c) : c == separator; };
  std::size_t at = 0;
  while (at <= line.size()) {
    while (at < line.size() && is_blank(line[at]) && (by_blanks || !ends_word(line[at]))) ++at;
    if (by_blanks && at == line.size()) break;
    const std::size_t first = at;
    std::string text;
    if (at < line.size() && line[at] == '"') text = unquoted(line, at);
    const std::size_t plain = at;
    while (at < line.size() && !ends_word(line[at])) ++at;
    std::string_view rest = line.substr(plain, at - plain);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    words.push_back({text + std::string(rest), static_cast<int>(first) + 1});
    ++at;
  }
  return words;
}

bool has(std::string_view line, char separator) {
  return find_unquoted(line, separator) != std::string_view::npos;
}

}  // namespace

std::pair<std::string_view, std::string_view> split_comment(std::string_view line) {
  const std::size_t at = find_unquoted(line, '#');
  if (at == std::string_view::npos) return {line, {}};
  return {line.substr(0, at), line.substr(at + 1)};
}

std::vector<Word> words_of(std::string_view line) {
  return split(line, has(line, ';') ? ';' : has(line, ',') ? ',' : ' ');
}

std::vector<Word> words_between(std::string_view line, char separator) {
  return split(line, separator);
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> comma_number_in(std::string_view text) {
  const auto comma = text.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma + 1 == text.size()) return {};
  const auto is_digit = [&](std::size_t at) { return text[at] >= '0' && text[at] <= '9'; };
  if (!is_digit(comma - 1) || !is_digit(comma + 1)) return std::nullopt;
  if (text.find('.') != std::string_view::npos) return std::nullopt;
  std::string with_point(text);
  with_point[comma] = '.';
  return number_in(with_point);
}

std::optional<Word> decimal_comma(std::string_view line) {
  std::vector<Word> words = split(line, has(line, ';') ? ';' : ' ');
  if (words.size() < 2) return std::nullopt;  // "1,2": as good as two numbers
  for (Word& word : words) {
    std::string text = word.text;
    if (text.ends_with(',')) text.pop_back();  // "1,5, 2,5, 3,5"
    if (comma_number_in(text)) return Word{std::move(text), word.column};
  }
  return std::nullopt;
}

}  // namespace frustum::metrology

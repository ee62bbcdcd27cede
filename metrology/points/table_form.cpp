#include "metrology/points/table_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrology/points/column_heading.hpp"
#include "metrology/points/line_words.hpp"

namespace frustum::metrology {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

enum class Sign { none, point, comma, both };

// Digits with signs of decimals or thousands among them, and what those are.
Sign sign_of(std::string_view word) {
  std::size_t points = 0;
  std::size_t commas = 0;
  for (std::size_t at = 0; at < word.size(); ++at) {
    const char c = word[at];
    if (c != '.' && c != ',') continue;
    if (at == 0 || at + 1 == word.size() || !is_digit(word[at - 1]) || !is_digit(word[at + 1])) {
      return Sign::none;
    }
    ++(c == '.' ? points : commas);
  }
  std::string digits(word);
  std::erase_if(digits, [](char c) { return c == '.' || c == ','; });
  if (points + commas == 0 || !number_in(digits)) return Sign::none;
  if (points + commas > 1) return Sign::both;
  return commas == 1 ? Sign::comma : Sign::point;
}

// A number with one comma that separates no thousands: 0,5 and 1,25 and 1234,567.
bool shows_a_decimal_comma(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  const std::size_t comma = word.find(',');
  return comma > 3 || word.size() != comma + 4 || word.front() == '0';
}

struct Found {
  std::string text{};
  int line = 0;
  int column = 0;
};

class FormSearch {
 public:
  Result<TableForm> form_of(std::string_view text) {
    const auto has = [&](char c) { return text.find(c) != std::string_view::npos; };
    if (!has('\t') && !(has(';') && has(','))) return TableForm{};
    for (int line = 1; !text.empty() && is_table_; ++line) {
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      if (auto problem = take_line(text.substr(0, end), line)) return *problem;
      text.remove_prefix(end);
      text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
    }
    return verdict();
  }

 private:
  std::optional<Diagnostic> take_line(std::string_view whole, int line) {
    const auto [content, comment] = split_comment(whole);
    if (auto problem = take_comment(comment, line, static_cast<int>(content.size()) + 1)) {
      return problem;
    }
    if (content.find_first_not_of(" \t") == std::string_view::npos) return std::nullopt;
    const bool is_first = std::exchange(is_first_, false);
    if (is_first && (is_separator_line(content) || is_count(content))) {
      is_first_ = is_separator_line(content);
      return std::nullopt;
    }
    const char separator = content.find(';') != std::string_view::npos    ? ';'
                           : content.find('\t') != std::string_view::npos ? '\t'
                                                                          : '\0';
    if (separator_ == 0) separator_ = separator;
    is_table_ = separator != 0 && separator == separator_;
    if (!is_table_) return std::nullopt;
    has_comma_ = has_comma_ || content.find(',') != std::string_view::npos;
    take_words(words_between(content, separator), line);
    return std::nullopt;
  }

  std::optional<Diagnostic> take_comment(std::string_view comment, int line, int column) {
    std::string text;
    for (const char c : comment) {
      if (c != ' ' && c != '\t')
        text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    constexpr std::string_view kKey = "decimal:";
    if (!text.starts_with(kKey)) return std::nullopt;
    text.erase(0, kKey.size());
    if (text == "comma") is_stated_ = true;
    if (text == "point") states_point_ = true;
    if (text == "comma" || text == "point") return std::nullopt;
    return placed({.text = text, .line = line, .column = column},
                  fmt::format("'{}' is not a sign of decimals", text),
                  "write # decimal: comma, or # decimal: point");
  }

  static bool is_count(std::string_view line) {
    const std::vector<Word> words = words_of(line);
    return words.size() == 1 && number_in(words.front().text);
  }

  void take_words(const std::vector<Word>& words, int line) {
    // Tabs stand beside commas that separate columns, too.
    if (separator_ == '\t' && words.size() < 3) {
      is_table_ = false;
      return;
    }
    if (fields_ == 0) fields_ = words.size();
    is_even_ = is_even_ && words.size() == fields_ &&
               std::ranges::none_of(words, [](const Word& word) { return word.text.empty(); });
    if (std::exchange(is_header_due_, false) && is_header(words)) {
      for (const Word& word : words) {
        const std::string name = column_heading(word.text).name;
        const auto known = known_columns();
        // What nobody knows is refused by its heading, not by what is below it.
        is_text_.push_back(is_text_column(name) || std::ranges::find(known, name) == known.end());
      }
      return;
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (i < is_text_.size() && is_text_[i]) continue;
      take_number(words[i], line);
    }
  }

  static bool is_header(const std::vector<Word>& words) {
    const auto is_number = [](const Word& word) {
      return number_in(word.text) || sign_of(word.text) != Sign::none;
    };
    return !is_number(words.front()) && !is_number(words.back());
  }

  void take_number(const Word& word, int line) {
    const auto note = [&](std::optional<Found>& place) {
      if (!place) place = Found{word.text, line, word.column};
    };
    switch (sign_of(word.text)) {
      case Sign::none:
        break;
      case Sign::point:
        note(point_);
        break;
      case Sign::both:
        note(both_);
        break;
      case Sign::comma:
        note(comma_);
        is_shown_ = is_shown_ || shows_a_decimal_comma(word.text);
        break;
    }
  }

  [[nodiscard]] Result<TableForm> verdict() const {
    if (!is_table_ || separator_ == 0) return TableForm{};
    if (both_) {
      return placed(
          *both_, fmt::format("'{}' has more than one sign of decimals or thousands", both_->text),
          "write numbers without separators of thousands");
    }
    if (!comma_) {
      const bool by_tabs = separator_ == '\t' && is_even_ && !has_comma_;
      return TableForm{by_tabs ? '\t' : '\0', false};
    }
    if (point_) return mixture(*comma_, *point_);
    if (states_point_) {
      return placed(*comma_,
                    fmt::format("'{}' has a comma, and the file states a point", comma_->text),
                    "write numbers as the file says, or correct what it says");
    }
    if (!is_shown_ && !is_stated_) {
      return placed(*comma_,
                    fmt::format("'{}' may have a decimal comma or a separator of thousands: every "
                                "comma here has three digits after it",
                                comma_->text),
                    "say which above the points: # decimal: comma; else leave separators out");
    }
    return TableForm{separator_, true};
  }

  static Diagnostic mixture(const Found& comma, const Found& point) {
    const bool comma_first =
        comma.line < point.line || (comma.line == point.line && comma.column < point.column);
    const Found& first = comma_first ? comma : point;
    const Found& second = comma_first ? point : comma;
    return placed(second,
                  fmt::format("'{}' has a {}, '{}' in line {} a {}", second.text,
                              comma_first ? "point" : "comma", first.text, first.line,
                              comma_first ? "comma" : "point"),
                  "write all numbers of a table with the same sign of decimals");
  }

  static Diagnostic placed(const Found& at, std::string message, std::string hint) {
    Diagnostic d = error("decimal-comma"_id, std::move(message), std::move(hint));
    d.line = at.line;
    d.column = at.column;
    return d;
  }

  char separator_ = 0;
  bool is_table_ = true;  // so far
  bool is_first_ = true;  // of the lines that are not blank
  bool is_header_due_ = true;
  bool is_stated_ = false;  // "# decimal: comma"
  bool states_point_ = false;
  bool has_comma_ = false;  // anywhere
  bool is_even_ = true;     // as many fields in every line, none empty
  std::size_t fields_ = 0;  // of the first line
  bool is_shown_ = false;   // by a number
  std::vector<bool> is_text_{};
  std::optional<Found> point_{};
  std::optional<Found> comma_{};
  std::optional<Found> both_{};
};

}  // namespace

Result<TableForm> table_form(std::string_view text) { return FormSearch().form_of(text); }

bool is_separator_line(std::string_view line) {
  return line == "sep=;" || line == "sep=," || line == "sep=\t" || line == "sep=";
}

}  // namespace frustum::metrology

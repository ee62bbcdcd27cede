#include "report/wording.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "report/number_text.hpp"

namespace frustum::report {
namespace {

constexpr double kMmPerInch = 25.4;

// What an inch report shows instead of a unit of length.
struct InchRow {
  std::string_view metric, inch;
  double per_metric;
  int decimals;  // of value()
  std::string_view symbol;
};
constexpr std::array kInchRows{
    InchRow{"um", "uin", 1e3 / kMmPerInch, 2, "µin"},
    InchRow{"nm", "uin", 1.0 / kMmPerInch, 2, "µin"},
    InchRow{"mm", "in", 1.0 / kMmPerInch, 6, "in"},
    InchRow{"mm/min", "in/min", 1.0 / kMmPerInch, 2, "in/min"},
    InchRow{"mm3", "in3", 1.0 / (kMmPerInch * kMmPerInch * kMmPerInch), 4, "in³"}};

const InchRow* inch_row(std::string_view metric) {
  for (const InchRow& row : kInchRows) {
    if (row.metric == metric) return &row;
  }
  return nullptr;
}

// What `text` has where `pattern` has {0}, {1}; nothing where they differ otherwise.
std::optional<std::vector<std::string>> filled_in(std::string_view pattern, std::string_view text) {
  std::vector<std::string> found;
  while (true) {
    const std::size_t open = pattern.find('{');
    if (open == pattern.npos) {
      if (pattern != text) return std::nullopt;
      return found;
    }
    if (!text.starts_with(pattern.substr(0, open))) return std::nullopt;
    text.remove_prefix(open);
    pattern.remove_prefix(pattern.find('}', open) + 1);
    const std::string_view next = pattern.substr(0, pattern.find('{'));
    const std::size_t end = next.empty() ? text.size() : text.find(next);
    if (end == text.npos || end == 0) return std::nullopt;
    found.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

}  // namespace

std::string Wording::filled(std::string_view text, std::initializer_list<std::string> parts) {
  std::string whole;
  while (!text.empty()) {
    const std::size_t open = text.find('{');
    whole += text.substr(0, open);
    if (open == text.npos) break;
    const auto place = static_cast<std::size_t>(text[open + 1] - '0');
    if (place < parts.size()) whole += parts.begin()[place];
    text.remove_prefix(open + 3);  // {0}
  }
  return whole;
}

std::string_view Wording::code() const { return style_.language == Language::german ? "de" : "en"; }

std::string Wording::word(std::string_view english) const {
  const PhraseRow* row = phrase_row(english);
  return std::string(row == nullptr ? english : text_of(*row, style_.language));
}

std::string Wording::sentence(std::string_view english) const {
  if (style_.language == Language::english) return std::string(english);
  for (const PhraseRow& row : kSentenceRows) {
    const auto parts = filled_in(row.english, english);
    if (!parts) continue;
    const std::string first = parts->empty() ? "" : parts->front();
    const std::string second = parts->size() < 2 ? "" : (*parts)[1];
    return filled(text_of(row, style_.language), {first, second});
  }
  return std::string(english);
}

std::string Wording::number(std::string text) const {
  if (style_.language == Language::english) return text;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    const auto is_digit = [&](std::size_t k) { return text[k] >= '0' && text[k] <= '9'; };
    if (text[i] == '.' && is_digit(i - 1) && is_digit(i + 1)) text[i] = ',';
  }
  return text;
}

std::string Wording::fixed(double value, int decimals) const {
  return number(fixed_text(value, decimals));
}

std::string Wording::general(double value) const { return number(fmt::format("{:g}", value)); }

std::string_view Wording::unit(std::string_view of) const {
  const InchRow* row = is_inch() ? inch_row(of) : nullptr;
  return row == nullptr ? of : row->inch;
}

double Wording::shown(double value, std::string_view of) const {
  const InchRow* row = is_inch() ? inch_row(of) : nullptr;
  return row == nullptr ? value : value * row->per_metric;
}

std::string Wording::symbol(std::string_view of) const {
  const InchRow* row = is_inch() ? inch_row(of) : nullptr;
  return row == nullptr ? unit_symbol(of) : std::string(row->symbol);
}

std::string Wording::value(double value, std::string_view of) const {
  const InchRow* row = is_inch() ? inch_row(of) : nullptr;
  if (row == nullptr) return number(value_text(value, of));
  return fixed(value * row->per_metric, row->decimals);
}

std::string Wording::uncertainty(double value, std::string_view of) const {
  return number(uncertainty_text(shown(value, of)));
}

std::string Wording::amount(double value, std::string_view of) const {
  return general(shown(value, of)) + " " + symbol(of);
}

std::string Wording::result(const metrology::CharacteristicResult& c) const {
  const std::string text = value(c.value, c.unit);
  const bool is_positive = text.find_first_of("123456789") != std::string::npos && text[0] != '-';
  return c.nominal == 0.0 && is_positive ? "+" + text : text;
}

std::string Wording::nominal(const metrology::CharacteristicResult& c) const {
  if (!c.nominal || *c.nominal == 0.0) return "";
  return value(*c.nominal, c.unit);
}

std::string Wording::interval(const metrology::CharacteristicResult& c) const {
  if (!c.interval) return "";
  return value(c.interval->low, c.unit) + " .. " + value(c.interval->high, c.unit);
}

}  // namespace frustum::report

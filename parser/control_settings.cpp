#include "parser/control_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/decimal.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

constexpr std::array<std::string_view, kDecimalPoints.size()> kDecimalPointNames{"calculator",
                                                                                 "increment"};
constexpr std::array<std::string_view, kStartUnits.size()> kStartUnitNames{"mm", "inch"};
constexpr double kLargestCode = 99'999.0;

}  // namespace

std::string_view name_of(DecimalPoint rule) {
  return kDecimalPointNames.at(static_cast<std::size_t>(rule));
}

std::optional<DecimalPoint> decimal_point_named(std::string_view name) {
  for (const DecimalPoint rule : kDecimalPoints) {
    if (name_of(rule) == name) return rule;
  }
  return std::nullopt;
}

std::string_view name_of(LengthUnit unit) {
  return kStartUnitNames.at(unit == LengthUnit::millimetre ? 0 : 1);
}

std::optional<LengthUnit> start_unit_named(std::string_view name) {
  for (const LengthUnit unit : kStartUnits) {
    if (name_of(unit) == name) return unit;
  }
  return std::nullopt;
}

Result<ControlWord> control_word(std::string_view text) {
  const auto wrong = [&] {
    return error("control-word"_id, fmt::format("{} is no G or M word", text),
                 "write a letter and its number, for example M31 or G187");
  };
  if (text.size() < 2) return wrong();
  const char letter = upper(text.front());
  if (letter != 'G' && letter != 'M') return wrong();
  double number = 0.0;
  const auto read = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return wrong();
  const double tenths = std::round(number * 10.0);
  if (!(number >= 0.0 && number <= kLargestCode) || std::abs(number * 10.0 - tenths) > 1e-6) {
    return wrong();
  }
  return ControlWord{letter, static_cast<int>(tenths)};
}

std::string name_of(ControlWord word) {
  return word.letter + shortest_decimal(static_cast<double>(word.tenths) / 10.0);
}

bool ControlSettings::has(ControlWord word) const {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace frustum::parser

// What the builder of a machine, and the parameters of its control, make of a program's words.
//
// Units : none
// Errors: what is no G or M word; names of decimal-point rules
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "parser/language/modes.hpp"

namespace frustum::parser {

// How a number without a decimal point counts, of words that take one: as it is written (calculator
// type), or in the least increments of the axes: 0.001 mm, 0.0001 inch, 0.001 degrees.
enum class DecimalPoint : std::uint8_t { calculator, increment };
inline constexpr std::array kDecimalPoints{DecimalPoint::calculator, DecimalPoint::increment};
[[nodiscard]] std::string_view name_of(DecimalPoint rule);
[[nodiscard]] std::optional<DecimalPoint> decimal_point_named(std::string_view name);

// The unit of lengths before any word of the program gives one: "mm", "inch".
inline constexpr std::array kStartUnits{LengthUnit::millimetre, LengthUnit::inch};
[[nodiscard]] std::string_view name_of(LengthUnit unit);
[[nodiscard]] std::optional<LengthUnit> start_unit_named(std::string_view name);

// A G or M word, by ten times its number.
struct ControlWord {
  char letter = 'M';
  int tenths = 0;

  bool operator==(const ControlWord&) const = default;
};
// "M31", "m031", "G187", "G5.1".
[[nodiscard]] Result<ControlWord> control_word(std::string_view text);
[[nodiscard]] std::string name_of(ControlWord word);

struct ControlSettings {
  // Words of the builder that move no axis and cut nothing: they become events of the grade
  // `known`. M words that nobody knows are events of the grade `builder` without.
  std::vector<ControlWord> words{};
  DecimalPoint decimal_point = DecimalPoint::calculator;
  std::optional<LengthUnit> unit{};  // where it is not known, mm is an assumption
  // That run again, before they are taken for an endless loop.
  std::optional<std::uint64_t> max_blocks{};
  // Before the first F the control has a feed of its own (Fanuc's parameter 1411), which is 0 in
  // the motions; else cutting without one is an error, as it always is where errors do not end the
  // run (InterpreterOptions::go_on).
  bool feed_before_first_word = true;

  [[nodiscard]] bool has(ControlWord word) const;
};

}  // namespace frustum::parser

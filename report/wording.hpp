// How a report speaks: its language, the sign between the digits, its units of length.
//
// Of pages and texts for people alone: files for programs are in English and mm always.
// Units  : as the texts say: µm and mm, or µin and in; angles and times are the same in both
// Errors : none; text that is in no table stays as it is
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>

#include "metrology/measurement.hpp"
#include "report/phrases.hpp"

namespace frustum::report {

enum class LengthUnits { millimetre, inch };

struct ReportStyle {
  Language language = Language::english;
  LengthUnits lengths = LengthUnits::millimetre;

  bool operator==(const ReportStyle&) const = default;
};

class Wording {
 public:
  explicit Wording(ReportStyle style = {}) : style_(style) {}
  [[nodiscard]] const ReportStyle& style() const { return style_; }
  [[nodiscard]] bool is_inch() const { return style_.lengths == LengthUnits::inch; }
  // "en", "de"
  [[nodiscard]] std::string_view code() const;

  [[nodiscard]] std::string operator()(Phrase phrase) const {
    return std::string(phrase.in(style_.language));
  }
  // With texts and whole numbers in the places {0}, {1} .. of the phrase.
  template <typename... Args>
  [[nodiscard]] std::string operator()(Phrase phrase, const Args&... args) const {
    return filled(phrase.in(style_.language), {part_of(args)...});
  }
  // A word that comes with the data: in this language where the table has it, else as it is.
  [[nodiscard]] std::string word(std::string_view english) const;
  // The same of a text that may be one of the table with something filled in: "radial motion of C
  // in X".
  [[nodiscard]] std::string sentence(std::string_view english) const;

  // A number that is text already, with the sign of this language between its digits.
  [[nodiscard]] std::string number(std::string text) const;
  [[nodiscard]] std::string fixed(double value, int decimals) const;
  [[nodiscard]] char decimal_sign() const {
    return style_.language == Language::german ? ',' : '.';
  }
  // As {:g} writes it.
  [[nodiscard]] std::string general(double value) const;

  // Of a unit as results have it ("um", "mm", "urad", "mm/min", "mm3", ..): the unit that is shown,
  // how many of it are one of the other, and its symbol.
  [[nodiscard]] std::string_view unit(std::string_view of) const;
  [[nodiscard]] double shown(double value, std::string_view of) const;
  [[nodiscard]] std::string symbol(std::string_view of) const;
  // With the decimals of value_text(), in the shown unit, without it.
  [[nodiscard]] std::string value(double value, std::string_view of) const;
  // Two significant digits.
  [[nodiscard]] std::string uncertainty(double value, std::string_view of) const;
  // As general(), with the symbol after a blank.
  [[nodiscard]] std::string amount(double value, std::string_view of) const;
  // As number_text.hpp has them, in the shown unit.
  [[nodiscard]] std::string result(const metrology::CharacteristicResult& c) const;
  [[nodiscard]] std::string nominal(const metrology::CharacteristicResult& c) const;
  [[nodiscard]] std::string interval(const metrology::CharacteristicResult& c) const;

  [[nodiscard]] static std::string filled(std::string_view text,
                                          std::initializer_list<std::string> parts);

 private:
  [[nodiscard]] static std::string part_of(std::string_view text) { return std::string(text); }
  template <std::integral Number>
  [[nodiscard]] static std::string part_of(Number number) {
    return std::to_string(number);
  }

  ReportStyle style_;
};

}  // namespace frustum::report

// Every text of the result page and of its summary on a terminal, in English and German: the only
// place where either is written.
//
// A phrase is known by its English text, which is checked when it is compiled: a text that is not
// in the table, or is there twice, does not compile. {0}, {1} .. are filled in; they may be in
// another order in German. Names of kinds are those of plans ("roundness").
// Units  : none; texts with numbers get them with their units
// Errors : none
// Source : German terms of DIN EN ISO 1101, DIN EN ISO 14253-1, DIN EN ISO 10360, DIN ISO 230-1,
//          JCGM 200 (VIM)
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "report/phrase_rows.hpp"

namespace frustum::report {

enum class Language { english, german };

[[nodiscard]] constexpr std::string_view text_of(const PhraseRow& row, Language language) {
  return language == Language::german ? row.german : row.english;
}

// The row of an English text; nothing where there is none.
[[nodiscard]] constexpr const PhraseRow* phrase_row(std::string_view english) {
  for (const auto& part : kPhraseParts) {
    for (std::size_t i = 0; i < part.count; ++i) {
      if (part.rows[i].english == english) return &part.rows[i];
    }
  }
  return nullptr;
}

// A text of the table, made of a literal alone.
class Phrase {
 public:
  // Implicit: wherever a phrase is asked for, its English text stands.
  consteval Phrase(const char* english) : row_(phrase_row(english)) {  // NOLINT
    if (row_ == nullptr) throw "not in report/phrase_rows.hpp";        // a compile-time error
  }
  [[nodiscard]] constexpr std::string_view in(Language language) const {
    return text_of(*row_, language);
  }

 private:
  const PhraseRow* row_;
};

}  // namespace frustum::report

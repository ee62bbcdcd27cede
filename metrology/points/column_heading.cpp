#include "metrology/points/column_heading.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "metrology/points/length_unit.hpp"

namespace frustum::metrology {
namespace {

constexpr std::array<std::string_view, 17> kNames{
    "feature",   "section",     "x",           "y",           "z",         "i",
    "j",         "k",           "weight",      "nominal_x",   "nominal_y", "nominal_z",
    "deviation", "deviation_x", "deviation_y", "deviation_z", "point"};

struct ColumnRow {
  std::string_view heading;  // words in lower case with _ between them
  std::string_view name;
};
constexpr std::array kHeadings{
    ColumnRow{"feature_name", "feature"},
    ColumnRow{"featurename", "feature"},
    ColumnRow{"element", "feature"},
    ColumnRow{"element_name", "feature"},
    ColumnRow{"elementname", "feature"},
    ColumnRow{"geometrieelement", "feature"},
    ColumnRow{"schnitt", "section"},
    ColumnRow{"gewicht", "weight"},
    ColumnRow{"dev", "deviation"},
    ColumnRow{"abweichung", "deviation"},
    ColumnRow{"abw", "deviation"},
    ColumnRow{"point_no", "point"},
    ColumnRow{"point_number", "point"},
    ColumnRow{"no", "point"},
    ColumnRow{"nr", "point"},
    ColumnRow{"punkt", "point"},
    ColumnRow{"punkt_nr", "point"},
    ColumnRow{"punktnr", "point"},
    ColumnRow{"punktnummer", "point"},
    ColumnRow{"nx", "i"},
    ColumnRow{"ny", "j"},
    ColumnRow{"nz", "k"},
    ColumnRow{"normal_x", "i"},
    ColumnRow{"normal_y", "j"},
    ColumnRow{"normal_z", "k"},
    ColumnRow{"normale_x", "i"},
    ColumnRow{"normale_y", "j"},
    ColumnRow{"normale_z", "k"},
};

// What is said beside the letter of a coordinate.
enum class Said { measured, nominal, deviation };
struct SaidRow {
  std::string_view word;
  Said meaning;
};
constexpr std::array kSaid{
    SaidRow{"act", Said::measured},        SaidRow{"actual", Said::measured},
    SaidRow{"meas", Said::measured},       SaidRow{"measured", Said::measured},
    SaidRow{"coord", Said::measured},      SaidRow{"coordinate", Said::measured},
    SaidRow{"ist", Said::measured},        SaidRow{"istwert", Said::measured},
    SaidRow{"messwert", Said::measured},   SaidRow{"gemessen", Said::measured},
    SaidRow{"koord", Said::measured},      SaidRow{"koordinate", Said::measured},
    SaidRow{"nom", Said::nominal},         SaidRow{"nominal", Said::nominal},
    SaidRow{"theo", Said::nominal},        SaidRow{"theoretical", Said::nominal},
    SaidRow{"soll", Said::nominal},        SaidRow{"sollwert", Said::nominal},
    SaidRow{"nennwert", Said::nominal},    SaidRow{"dev", Said::deviation},
    SaidRow{"deviation", Said::deviation}, SaidRow{"abw", Said::deviation},
    SaidRow{"abweichung", Said::deviation}};

// "X-Istwert" as x, istwert.
std::vector<std::string> words_in(std::string_view heading) {
  std::vector<std::string> words(1);
  for (const char c : heading) {
    if (std::string_view(" \t-_./:").find(c) == std::string_view::npos) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_letter_of(std::string_view word, std::string_view letters) {
  return word.size() == 1 && letters.find(word.front()) != std::string_view::npos;
}

// The column of a coordinate or direction and of what is said of it; empty when that is unclear.
std::string coordinate_column(const std::vector<std::string>& words) {
  std::string_view letter;
  const SaidRow* said = nullptr;
  for (const std::string& word : words) {
    if (is_letter_of(word, "xyzijk")) {
      if (!letter.empty()) return {};
      letter = word;
      continue;
    }
    const auto* row = std::find_if(kSaid.begin(), kSaid.end(),
                                   [&](const SaidRow& each) { return each.word == word; });
    if (row == kSaid.end() || (said != nullptr && said->meaning != row->meaning)) return {};
    said = row;
  }
  if (letter.empty()) return {};
  if (said == nullptr || said->meaning == Said::measured) return std::string(letter);
  if (!is_letter_of(letter, "xyz")) return {};
  return (said->meaning == Said::nominal ? "nominal_" : "deviation_") + std::string(letter);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "_") + word;
  return text;
}

std::string name_of(const std::vector<std::string>& words) {
  const std::string text = joined(words);
  if (std::ranges::find(kNames, text) != kNames.end()) return text;
  for (const ColumnRow& row : kHeadings) {
    if (row.heading == text) return std::string(row.name);
  }
  return coordinate_column(words);
}

}  // namespace

std::span<const std::string_view> known_columns() { return kNames; }

bool is_text_column(std::string_view name) { return name == "feature" || name == "point"; }

ColumnHeading column_heading(std::string_view text) {
  const NameWithUnit bracketed = name_with_unit(text);
  ColumnHeading heading{bracketed.name, bracketed.unit};
  std::vector<std::string> words = words_in(heading.name);
  if (std::string name = name_of(words); !name.empty()) {
    heading.name = std::move(name);
    return heading;
  }
  // "x_act_mm", "X / mm", "X in mm": the unit is a word of its own.
  if (!heading.unit.empty() || words.size() < 2 || !length_unit(words.back())) return heading;
  const std::string unit = words.back();
  words.pop_back();
  if (words.size() > 1 && words.back() == "in") words.pop_back();
  if (std::string name = name_of(words); !name.empty()) return {std::move(name), unit};
  return heading;
}

}  // namespace frustum::metrology

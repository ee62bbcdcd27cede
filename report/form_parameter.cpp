#include "report/form_parameter.hpp"

#include <algorithm>
#include <array>

namespace frustum::report {
namespace {

struct KindSymbol {
  std::string_view kind;
  std::string_view symbol;
};
constexpr std::array kKindSymbols{KindSymbol{"roundness", "RON"}, KindSymbol{"cylindricity", "CYL"},
                                  KindSymbol{"straightness", "STR"}, KindSymbol{"flatness", "FLT"}};

struct ParameterWords {
  std::string_view parameter;
  Phrase words;
};
constexpr std::array kParameterWords{
    ParameterWords{"t", "peak to valley"}, ParameterWords{"p", "highest peak"},
    ParameterWords{"v", "deepest valley"}, ParameterWords{"q", "root mean square"}};

std::string words_of(std::string_view parameter, const Wording& words) {
  for (const ParameterWords& row : kParameterWords) {
    if (row.parameter == parameter) return words(row.words);
  }
  return std::string(parameter);
}

std::string standard_symbol(std::string_view kind, std::string_view parameter) {
  for (const KindSymbol& row : kKindSymbols) {
    if (row.kind == kind) return std::string(row.symbol) + std::string(parameter);
  }
  return {};
}

std::string with_parameter(const std::string& text, const metrology::CharacteristicResult& c,
                           const Wording& words) {
  const std::string symbol = parameter_symbol(c.kind, c.parameter, words);
  return symbol.empty() ? text : text + " " + symbol;
}

}  // namespace

std::string parameter_symbol(std::string_view kind, std::string_view parameter,
                             const Wording& words) {
  if (parameter.empty()) return {};
  const std::string symbol = standard_symbol(kind, parameter);
  return symbol.empty() ? words_of(parameter, words) : symbol;
}

std::string parameter_text(std::string_view kind, std::string_view parameter,
                           const Wording& words) {
  if (parameter.empty()) return {};
  const std::string symbol = standard_symbol(kind, parameter);
  return symbol.empty() ? words_of(parameter, words) : symbol + ", " + words_of(parameter, words);
}

std::string kind_text(const metrology::CharacteristicResult& characteristic, const Wording& words) {
  return with_parameter(words.word(characteristic.kind), characteristic, words);
}

std::string subject_text(const metrology::CharacteristicResult& c, const Wording& words) {
  if (c.features.empty()) return {};
  constexpr std::array<std::string_view, 7> kToDatums{
      "perpendicularity", "parallelism",      "angularity",   "coaxiality",
      "concentricity",    "circular_run_out", "total_run_out"};
  const bool has_datums = std::ranges::find(kToDatums, c.kind) != kToDatums.end();
  std::string text = c.features.front();
  for (std::size_t k = 1; k < c.features.size(); ++k) {
    text += (has_datums && k == 1 ? words(" to ") : ", ") + c.features[k];
  }
  for (std::size_t k = 0; k < c.sections.size(); ++k) {
    text += k > 0 ? ", " : c.sections.size() > 1 ? words(", sections ") : words(", section ");
    text += std::to_string(c.sections[k]);
  }
  return c.frame.empty() ? text : words("{0} in frame {1}", text, c.frame);
}

std::string name_text(const metrology::CharacteristicResult& characteristic, const Wording& words) {
  return with_parameter(characteristic.name, characteristic, words);
}

}  // namespace frustum::report

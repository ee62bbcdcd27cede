#include "report/form_parameter.hpp"

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
  std::string_view words;
};
constexpr std::array kParameterWords{
    ParameterWords{"t", "peak to valley"}, ParameterWords{"p", "highest peak"},
    ParameterWords{"v", "deepest valley"}, ParameterWords{"q", "root mean square"}};

std::string words_of(std::string_view parameter) {
  for (const ParameterWords& row : kParameterWords) {
    if (row.parameter == parameter) return std::string(row.words);
  }
  return std::string(parameter);
}

std::string standard_symbol(std::string_view kind, std::string_view parameter) {
  for (const KindSymbol& row : kKindSymbols) {
    if (row.kind == kind) return std::string(row.symbol) + std::string(parameter);
  }
  return {};
}

std::string with_parameter(const std::string& text, const metrology::CharacteristicResult& c) {
  const std::string symbol = parameter_symbol(c.kind, c.parameter);
  return symbol.empty() ? text : text + " " + symbol;
}

}  // namespace

std::string parameter_symbol(std::string_view kind, std::string_view parameter) {
  if (parameter.empty()) return {};
  const std::string symbol = standard_symbol(kind, parameter);
  return symbol.empty() ? words_of(parameter) : symbol;
}

std::string parameter_text(std::string_view kind, std::string_view parameter) {
  if (parameter.empty()) return {};
  const std::string symbol = standard_symbol(kind, parameter);
  return symbol.empty() ? words_of(parameter) : symbol + ", " + words_of(parameter);
}

std::string kind_text(const metrology::CharacteristicResult& characteristic) {
  return with_parameter(characteristic.kind, characteristic);
}

std::string name_text(const metrology::CharacteristicResult& characteristic) {
  return with_parameter(characteristic.name, characteristic);
}

}  // namespace frustum::report

// Words of Sinumerik around a value and before a variable: AC(5), DEF REAL.
//
// Units : none
// Errors: none
#pragma once

#include <array>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/language/variable_kind.hpp"

namespace frustum::parser {

struct MeasureName {
  std::string_view name;
  Measure measure;
};
inline constexpr std::array kMeasureNames{
    MeasureName{"AC", Measure::absolute}, MeasureName{"IC", Measure::incremental},
    MeasureName{"DC", Measure::shortest}, MeasureName{"ACP", Measure::positive},
    MeasureName{"ACN", Measure::negative}};

struct TypeName {
  std::string_view name;
  VariableKind kind;
};
inline constexpr std::array kTypeNames{
    TypeName{"REAL", VariableKind::real},  TypeName{"INT", VariableKind::whole},
    TypeName{"BOOL", VariableKind::truth}, TypeName{"STRING", VariableKind::text},
    TypeName{"AXIS", VariableKind::axis},  TypeName{"CHAR", VariableKind::character}};

}  // namespace frustum::parser

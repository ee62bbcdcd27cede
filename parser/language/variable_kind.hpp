// What a defined variable holds.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>

namespace frustum::parser {

enum class VariableKind : std::uint8_t { real, whole, truth, text, axis, character };

}  // namespace frustum::parser

// The symbol of ISO 1101 for a characteristic, drawn: few fonts have them all.
//
// Units: none. Errors: none; a kind without a symbol (a radius, an angle) gives no text.
// Source: ISO 1101:2017, table 2; ISO 7083 for the proportions
#pragma once

#include <string>
#include <string_view>

#include "report/wording.hpp"

namespace frustum::report {

// Inline SVG of the height of a line; `kind` as plans name it.
[[nodiscard]] std::string tolerance_symbol(std::string_view kind, const Wording& words);

}  // namespace frustum::report

// Custom Macro B: `WHILE [#1 LT 5] DO1`, `END1`, `IF [c] GOTO 100`, `IF [c] THEN #2=1`, `GOTO #3`.
//
// Units : none
// Errors: a condition, number or keyword that is missing, words beside the statement; with line and
//         column
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

// A block of Fanuc's, with a statement or without.
[[nodiscard]] Result<Block> read_fanuc_block(std::string_view text, std::uint32_t line);

}  // namespace frustum::parser

// O words of RS-274: `o100 while [#1 LT 5]`, `o<pocket> call [1] [2]`.
//
// Units : none
// Errors: an unknown keyword, a missing label or expression, text after the statement; with line
//         and column
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

// A block of LinuxCNC, with an O word or without.
[[nodiscard]] Result<Block> read_linuxcnc_block(std::string_view text, std::uint32_t line);

}  // namespace frustum::parser

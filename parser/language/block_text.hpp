// Blocks as NC text: reading it again gives the same blocks (places aside).
//
// Units : as written
// Errors: none
#pragma once

#include <span>
#include <string>

#include "parser/language/block.hpp"

namespace frustum::parser {

[[nodiscard]] std::string to_text(const Block& block);
[[nodiscard]] std::string to_text(std::span<const Block> blocks);

}  // namespace frustum::parser

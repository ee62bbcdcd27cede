// Programs as NC text, in the spelling of their dialect: reading it again gives the same blocks
// (places aside).
//
// What a dialect can write in two ways is written in one: names of cycles, directions that a
// control leaves out and blanks are not kept.
// Units : as written
// Errors: none
#pragma once

#include <span>
#include <string>

#include "parser/dialect.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

// Blocks of one program from its start, in their order; a line each, but for arcs of CLDATA and for
// what had several comments.
[[nodiscard]] std::string to_text(std::span<const Block> blocks, Dialect dialect);

}  // namespace frustum::parser

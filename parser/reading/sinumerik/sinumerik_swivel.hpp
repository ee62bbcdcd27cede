// CYCLE800(...) of Sinumerik: the tilted plane as words of a block.
//
// Units : none
// Errors: a bracket or mode that is missing, parameters too many, a swivel on top of another; at
//         the draft's scanner
#pragma once

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

// What is after the name.
void read_sinumerik_swivel(BlockDraft& draft, std::uint32_t column);

}  // namespace frustum::parser

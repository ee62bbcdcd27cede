// The statements of Sinumerik programs that say which block comes next: IF, WHILE, FOR, GOTOF,
// labels.
//
// Units : none
// Errors: a condition, label or keyword that is missing, words beside the statement; at the draft's
//         scanner
#pragma once

#include <string>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

// The statement of that name; false when there is none.
[[nodiscard]] bool read_sinumerik_flow(BlockDraft& draft, const std::string& name,
                                       std::uint32_t column);
// NAME: before a block, the place of a jump.
void read_sinumerik_label(BlockDraft& draft, const std::string& name, std::uint32_t column);

}  // namespace frustum::parser

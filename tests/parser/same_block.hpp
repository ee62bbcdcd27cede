// Whether two blocks say the same.
//
// Units : none
// Errors: none
#pragma once

#include "parser/language/block.hpp"

namespace frustum::parser {

// Equal but for lines, columns, and how names and expressions are numbered.
[[nodiscard]] bool same_block(const Block& a, const Block& b);

}  // namespace frustum::parser

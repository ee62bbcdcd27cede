// What the text of a program says of itself, run or not: subprograms and labels that nothing names,
// blocks after an end, block numbers that a jump could mean twice, and syntax errors.
//
// Units : none
// Shape : one read of the text; another one when block numbers are jumped to
// Errors: none
#pragma once

#include <cstdint>
#include <set>

#include "lint/finding_list.hpp"
#include "parser/program.hpp"

namespace frustum::lint {

// Lines with a syntax error: the run need not report them again.
using WrongLines = std::set<std::uint32_t>;
WrongLines check_structure(const parser::Program& program, FindingList& findings);

}  // namespace frustum::lint

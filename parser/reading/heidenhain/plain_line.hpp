// Lines of Klartext that are straight moves by plain numbers, by far the most: 12 L X+1.5 Y-2 R0
// F500 M3. What is not such a line is left to the reader of statements.
//
// Units : none; values are as written
// Shape : the block that the reader of statements would give (plain_line_test.cpp)
// Errors: none
#pragma once

#include <cstdint>
#include <string_view>

#include "parser/language/block.hpp"

namespace frustum::parser {

// Whether the text is such a line; then it is read into `block`, which may be the plain line before
// it. Nothing but the line, the number and the words is set.
[[nodiscard]] bool read_plain_line(Block& block, std::string_view text, std::uint32_t line);

}  // namespace frustum::parser

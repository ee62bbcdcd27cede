// A line as LinuxCNC reads it: as if its blanks were not there, but in comments.
//
//   "g 0 x 1 . 5 (a b)"  is  "g0x1.5(a b)"
//
// Units : columns count bytes from 1
// Errors: none
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "parser/language/block.hpp"

namespace frustum::parser {

struct BlankFreeText {
  std::string text{};
  std::vector<std::uint32_t> columns{};  // in the line, of each byte of the text and of its end
};

[[nodiscard]] BlankFreeText without_blanks(std::string_view line);
// The columns of a block that was read from the text are then those of the line.
void restore_columns(Block& block, const BlankFreeText& text);

}  // namespace frustum::parser

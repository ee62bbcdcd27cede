// The wording of syntax errors: what the grammar expected and where it stopped -> message and hint.
//
// Units: columns count bytes from 1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"

namespace frustum::parser {

// What the grammar was in the middle of when it failed.
struct SyntaxFailure {
  std::string_view text;             // the whole block
  std::size_t offset = 0;            // where the text stops making sense (may be the end)
  std::string_view expected;         // name of the grammar rule that failed
  char word_letter = 0;              // the word being read; 0 outside words
  std::uint32_t word_column = 0;     // of that word, or of the parameter setting
  std::uint32_t opening_column = 0;  // of the innermost open bracket or comment; 0 when none
};

[[nodiscard]] Diagnostic describe(const SyntaxFailure& failure);

// "'$'", or "byte 0x1A" when it cannot be printed.
[[nodiscard]] std::string printable(char character);

}  // namespace frustum::parser

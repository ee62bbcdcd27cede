// Blocks of nothing but words with plain numbers, such as N10 G1 X1.5 Y-2 F500: most of a long
// program. They are read here without the grammar, which reads all others, and what it would read
// is read the same.
//
// Units : none; values are as written
// Errors: none; what is not plain, and what is wrong, is left to the grammar
#pragma once

#include <cstdint>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/language/letter_set.hpp"

namespace frustum::parser {

constexpr LetterSet kLettersOfRs274{"ABCDEFGHIJKLMPQRSTUVWXYZ"};

// Whether the text is a plain block; then it is read into `block`, which may be the plain block
// before it. Nothing but the line, the number, the mark / and the words is set. Words of other
// letters are not plain.
[[nodiscard]] bool read_plain_block(Block& block, std::string_view text, std::uint32_t line,
                                    LetterSet letters = kLettersOfRs274);

}  // namespace frustum::parser

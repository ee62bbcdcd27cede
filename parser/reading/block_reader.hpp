// Lines of text -> blocks, in the spelling of one dialect.
//
// A reader keeps what its language spreads over lines and what control flow cannot change (the
// CIRCLE before a GOTO, the name of BEGIN PGM); a new one belongs to each program.
// Units: none; values are as written.
// Errors: the first one of the block, with line, column and hint; the file is left to the caller.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "core/result.hpp"
#include "parser/dialect.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

// `text` is a block without its line feed at the end; one that goes over several lines has a line
// feed between them and a blank for each continuation mark.
using BlockReader = std::function<Result<Block>(std::string_view text, std::uint32_t line)>;
[[nodiscard]] BlockReader reader_of(Dialect dialect);

// Reads blocks that are words with plain numbers alone, as most of a long program is, one after the
// other into `block`, so that its memory is used again; false: the text is for the reader.
using PlainBlockReader = bool (*)(Block& block, std::string_view text, std::uint32_t line);
// Null where the dialect has none.
[[nodiscard]] PlainBlockReader plain_reader_of(Dialect dialect);

// Where the mark is that continues the line on the next one; npos when it ends here.
[[nodiscard]] std::size_t continuation_mark(std::string_view line, Dialect dialect);

// Of Klartext: a cycle without its parameters (CYCL DEF 200 DRILLING), which follow in lines such
// as Q200=2, though no mark says so.
[[nodiscard]] bool opens_parameter_lines(std::string_view line, Dialect dialect);
[[nodiscard]] bool is_parameter_line(std::string_view line);

[[nodiscard]] bool read_plain_sinumerik_block(Block& block, std::string_view text,
                                              std::uint32_t line);
[[nodiscard]] Result<Block> read_sinumerik_block(std::string_view text, std::uint32_t line);
[[nodiscard]] BlockReader heidenhain_reader();
[[nodiscard]] BlockReader cldata_reader();

}  // namespace frustum::parser

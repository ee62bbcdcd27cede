// The text of one block -> its words, settings and comments.
//
//   block      = "%" { comment }
//              | [ "/" ] [ N digits ] [ "/" ] { word | setting | comment | program }
//   program    = ( "O" | ":" ) digits
//   word       = letter ( [ sign ] number | operand )
//   setting    = "#" ( digits | "<" name ">" | "[" expression "]" | parameter ) "=" expression
//   comment    = "(" text ")" | ";" text
//
// Expressions and their operands are read by expression_reader.hpp. In Custom Macro "/" may name a
// switch: "/2"; ":" is of Custom Macro alone.
//
// Letters may be of either case; blanks (space, tab, carriage return) may be between any two
// tokens or nowhere. Numbers have no exponent.
// Units: none; values are as written.
// Errors: the first one of the block, with line, column and hint; the file is left to the caller.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "parser/dialect.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

// `text` is one line without its line feed; the dialect is LinuxCNC or Fanuc.
[[nodiscard]] Result<Block> parse_block(std::string_view text, std::uint32_t line,
                                        Dialect dialect = Dialect::linuxcnc);

}  // namespace frustum::parser

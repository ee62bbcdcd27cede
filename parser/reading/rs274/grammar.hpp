// The text of one block -> its words, settings and comments.
//
//   block      = "%" { comment }
//              | [ "/" ] [ N digits ] [ "/" ] { word | setting | comment | program }
//   program    = ( "O" | ":" ) digits
//   word       = letter value
//   setting    = parameter "=" logic
//   value      = [ sign ] ( number | parameter | function | "[" logic "]" )
//   logic      = relation { ( "AND" | "OR" | "XOR" ) relation }
//   relation   = sum { ( "EQ" | "NE" | "GT" | "GE" | "LT" | "LE" ) sum }
//   sum        = product { ( "+" | "-" ) product }
//   product    = power { ( "*" | "/" | "MOD" ) power }
//   power      = value { "**" value }
//   parameter  = "#" ( digits | "<" name ">" | "[" logic "]" | parameter )
//   function   = name "[" logic "]"
//              | "EXISTS" "[" "#" "<" name ">" "]"
//              | "ATAN" "[" logic "]" "/" "[" logic "]" | "ATAN" "[" logic "," logic "]"
//   comment    = "(" text ")" | ";" text
//
// In Custom Macro AND is a product, OR and XOR are sums, a level has one comparison, POW[x,y], BIN,
// BCD and ADP are functions besides, ATAN may have one argument, and "/" may name a switch: "/2".
// ":" is of Custom Macro alone.
//
// Letters may be of either case; blanks (space, tab, carriage return) may be between any two
// tokens or nowhere. A sign belongs to the value after it: -2**2 is 4, as in RS-274. Numbers have
// no exponent.
// Units: none; values are as written.
// Errors: the first one of the block, with line, column and hint; the file is left to the caller.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/block.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

enum class Arithmetic : std::uint8_t { rs274, custom_macro };

// `text` is one line without its line feed.
[[nodiscard]] Result<Block> parse_block(std::string_view text, std::uint32_t line,
                                        Arithmetic arithmetic = Arithmetic::rs274);

// One `value` at the scanner, put after the steps of the block.
void append_rs274_expression(LineScanner& in, Block& block, ExpressionRange& range,
                             Arithmetic arithmetic = Arithmetic::rs274);

}  // namespace frustum::parser

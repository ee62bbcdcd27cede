// Finding the words of a dialect.
//
// Units : none
// Errors: none; find_code returns null for what the dialect does not have
#pragma once

#include <string>
#include <string_view>

#include "parser/dialect.hpp"
#include "parser/dialects/code.hpp"

namespace frustum::parser {

[[nodiscard]] const Code* find_code(Dialect dialect, char letter, double number);
[[nodiscard]] const Code* find_code(Dialect dialect, std::string_view word);
// What a kNamedWord has for its number: a code of find_code(), and back.
[[nodiscard]] double row_of(const Code& code);
[[nodiscard]] const Code& code_at(double row);
// What to do instead of a code that would change the part and that is not simulated; empty when
// there is no such code.
[[nodiscard]] std::string_view remedy_for(Dialect dialect, char letter, double number);
[[nodiscard]] std::string_view remedy_for(Dialect dialect, std::string_view word);
// "TRAORI CYCLE800 ...": all known words.
[[nodiscard]] std::string known_words(Dialect dialect);
// "G73 G74 G80": the known codes of the letter that are nearest to a number.
[[nodiscard]] std::string codes_near(Dialect dialect, char letter, double number);

}  // namespace frustum::parser

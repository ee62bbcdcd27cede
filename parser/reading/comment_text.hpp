// The text of a comment as UTF-8: controllers and old editors write Latin-1, newer ones UTF-8.
// A carriage return within it is a blank.
//
// Units: none. Errors: none; text that is not valid UTF-8 is taken as Latin-1, which any bytes are.
#pragma once

#include <string>
#include <string_view>

namespace frustum::parser {

[[nodiscard]] std::string utf8_of(std::string_view bytes);

}  // namespace frustum::parser

// The writers of the dialects: block by block from the start of a program, without the line feed at
// the end.
//
// Some keep what later blocks are written by, as their readers do: the name of the program, the
// last place.
// Units : as written
// Errors: none
#pragma once

#include <functional>
#include <string>

#include "parser/dialect.hpp"
#include "parser/language/block.hpp"

namespace frustum::parser {

using BlockWriter = std::function<std::string(const Block& block)>;

[[nodiscard]] BlockWriter linuxcnc_writer();
[[nodiscard]] BlockWriter fanuc_writer();
[[nodiscard]] BlockWriter sinumerik_writer();
[[nodiscard]] BlockWriter heidenhain_writer();
[[nodiscard]] BlockWriter cldata_writer();

}  // namespace frustum::parser

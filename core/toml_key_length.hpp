// Keys of TOML that nest deeper than any file means: a.b.c.d and so on. Each name is a table in the
// one before; thousands of them would exhaust the stack of every reader.
//
// Model : names joined by dots outside of strings and comments; a number's dot counts as one
// Units : lines and columns from 1, columns in bytes
// Errors: none; text that is no TOML has any answer
// Source: TOML 1.0
#pragma once

#include <optional>
#include <string_view>

namespace frustum {

inline constexpr int kMostNamesInKey = 16;  // files of ours have up to four

struct TextPlace {
  int line = 1;
  int column = 1;
};
// Where the first key of more names than that begins.
[[nodiscard]] std::optional<TextPlace> overlong_key(std::string_view text);

}  // namespace frustum

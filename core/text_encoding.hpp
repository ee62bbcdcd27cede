// Text of files in the encodings that spreadsheets and measuring programs write.
//
// Read are UTF-8, with or without a byte order mark, and UTF-16 of either byte order, with a mark
// or, where the first character is one of ASCII, without.
// Units  : none
// Errors : UTF-32, UTF-16 that ends within a character or has half of one: each by its name
// Source : RFC 3629 (UTF-8), RFC 2781 (UTF-16)
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum {

// As UTF-8 without a mark. Bytes that are neither stay as they are: names of old files.
[[nodiscard]] Result<std::string> utf8_text(std::string_view bytes);

}  // namespace frustum

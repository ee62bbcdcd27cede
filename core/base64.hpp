// Bytes as text that XML, HTML and JSON carry unchanged.
//
// Units: none. Errors: none. Source: RFC 4648, section 4
#pragma once

#include <span>
#include <string>

namespace frustum {

[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

}  // namespace frustum

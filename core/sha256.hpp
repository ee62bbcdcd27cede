// The fingerprint of a file: who holds it and the file can tell that it is the same one.
//
// Units: none. Errors: none. Source: FIPS 180-4 (SHA-256), as OpenSSL computes it
#pragma once

#include <string>
#include <string_view>

namespace frustum {

// 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace frustum

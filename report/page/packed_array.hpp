// Number arrays packed into text for the page: differences, byte planes, deflate, base64.
//
// Packing: values as unsigned 32-bit; item k is replaced by its difference to item k - stride
// (modulo 2^32); the bytes are sorted into four planes, least significant first; the planes are
// deflated (zlib) and written in base64. report/page/packed_array.js turns it back.
// Units: none. Errors: none (running out of memory throws).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace frustum::report {

// `stride` > 0 is the number of interleaved columns: 3 for x, y, z.
[[nodiscard]] std::string packed_array(std::span<const std::uint32_t> values, std::size_t stride);
// Text, which is deflated and written in base64 alone.
[[nodiscard]] std::string packed_text(std::string_view text);

}  // namespace frustum::report

#include "parser/reading/comment_text.hpp"

#include <algorithm>
#include <bit>

namespace frustum::parser {
namespace {

constexpr unsigned kAsciiEnd = 0x80;

unsigned code(char character) { return static_cast<unsigned char>(character); }

// Bytes of the UTF-8 character at the start of `bytes`, or 0 when there is none.
std::size_t utf8_length(std::string_view bytes) {
  const unsigned lead = code(bytes.front());
  if (lead < kAsciiEnd) return 1;
  const auto length = static_cast<std::size_t>(std::countl_one(static_cast<unsigned char>(lead)));
  if (length < 2 || length > 4 || length > bytes.size()) return 0;
  unsigned point = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((code(bytes[i]) & 0xC0U) != kAsciiEnd) return 0;
    point = (point << 6U) | (code(bytes[i]) & 0x3FU);
  }
  constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xD800 && point < 0xE000;
  return point < kLeast[length] || point > 0x10FFFF || surrogate ? 0 : length;
}

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = utf8_length(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string utf8_of(std::string_view bytes) {
  const bool ascii =
      std::all_of(bytes.begin(), bytes.end(), [](char c) { return code(c) < kAsciiEnd; });
  std::string utf8;
  if (ascii || is_utf8(bytes)) {
    utf8 = bytes;
  } else {
    for (const char c : bytes) {
      if (code(c) < kAsciiEnd) {
        utf8 += c;
      } else {
        utf8 += static_cast<char>(0xC0U | (code(c) >> 6U));
        utf8 += static_cast<char>(kAsciiEnd | (code(c) & 0x3FU));
      }
    }
  }
  std::replace(utf8.begin(), utf8.end(), '\r', ' ');
  return utf8;
}

}  // namespace frustum::parser

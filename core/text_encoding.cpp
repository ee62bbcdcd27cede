#include "core/text_encoding.hpp"

#include <cstdint>

namespace frustum {
namespace {

using namespace std::string_view_literals;

enum class ByteOrder { little, big };

std::uint32_t unit_at(std::string_view bytes, std::size_t at, ByteOrder order) {
  const auto first = static_cast<unsigned char>(bytes[at]);
  const auto second = static_cast<unsigned char>(bytes[at + 1]);
  return order == ByteOrder::little ? first | second << 8U : second | first << 8U;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto tail = [&](unsigned shift) {
    text += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
  };
  if (code < 0x80U) {
    text += static_cast<char>(code);
  } else if (code < 0x800U) {
    text += static_cast<char>(0xC0U | (code >> 6U));
    tail(0);
  } else if (code < 0x10000U) {
    text += static_cast<char>(0xE0U | (code >> 12U));
    tail(6);
    tail(0);
  } else {
    text += static_cast<char>(0xF0U | (code >> 18U));
    tail(12);
    tail(6);
    tail(0);
  }
}

Diagnostic not_readable(std::string message) {
  return error("text-encoding"_id, std::move(message), "save the file as UTF-8");
}

Result<std::string> from_utf16(std::string_view bytes, ByteOrder order) {
  if (bytes.size() % 2 != 0) return not_readable("the file is UTF-16 and ends within a character");
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    const std::uint32_t unit = unit_at(bytes, at, order);
    if (unit < 0xD800U || unit > 0xDFFFU) {
      append_utf8(text, unit);
      continue;
    }
    // A character beyond the 65,536 first ones is a pair: its upper half, then its lower one.
    const std::uint32_t next = at + 2 < bytes.size() ? unit_at(bytes, at + 2, order) : 0U;
    if (unit > 0xDBFFU || next < 0xDC00U || next > 0xDFFFU) {
      return not_readable("the file is UTF-16 and has half a character");
    }
    append_utf8(text, 0x10000U + ((unit - 0xD800U) << 10U) + (next - 0xDC00U));
    at += 2;
  }
  return text;
}

}  // namespace

Result<std::string> utf8_text(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv)) {
    return not_readable("the file is UTF-32");
  }
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes.substr(2), ByteOrder::little);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes.substr(2), ByteOrder::big);
  if (bytes.starts_with("\xEF\xBB\xBF")) return std::string(bytes.substr(3));
  if (bytes.size() >= 2 && (bytes[0] == '\0') != (bytes[1] == '\0')) {
    return from_utf16(bytes, bytes[0] == '\0' ? ByteOrder::big : ByteOrder::little);
  }
  return std::string(bytes);
}

}  // namespace frustum

#include "core/printable_text.hpp"

#include <fmt/format.h>

namespace frustum {
namespace {

constexpr unsigned kDelete = 0x7FU;
// The controls U+0080 to U+009F are two bytes, of which this is the first.
constexpr unsigned kLatinLead = 0xC2U;

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned byte = byte_at(text, i), next = byte_at(text, i + 1);
    if (byte == kLatinLead && next >= 0x80U && next < 0xA0U) {
      shown += fmt::format("\\x{:02X}", next);
      ++i;
    } else if ((byte < 0x20U && text[i] != '\t') || byte == kDelete) {
      shown += fmt::format("\\x{:02X}", byte);
    } else {
      shown += text[i];
    }
  }
  return shown;
}

}  // namespace frustum

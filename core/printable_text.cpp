#include "core/printable_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum {
namespace {

constexpr unsigned kDelete = 0x7FU;
// The controls U+0080 to U+009F are two bytes, of which this is the first.
constexpr unsigned kLatinLead = 0xC2U;

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

constexpr std::size_t kLongestDigits = 40;
constexpr std::size_t kLongestWord = 300;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The end of a run of digits or of other characters that are no blanks.
std::size_t end_of_run(std::string_view text, std::size_t from) {
  const bool digits = is_digit(text[from]);
  std::size_t end = from;
  while (end < text.size() && text[end] != ' ' && is_digit(text[end]) == digits) ++end;
  return end;
}

std::size_t end_of_word(std::string_view text, std::size_t from) {
  return std::min(text.find(' ', from), text.size());
}

// The first ones, whole characters of UTF-8.
std::string beginning(std::string_view text, std::size_t count) {
  while (count > 0 && (static_cast<unsigned char>(text[count]) & 0xC0U) == 0x80U) --count;
  return fmt::format("{}... ({} characters)", text.substr(0, count), text.size());
}

}  // namespace

std::string shortened(std::string text) {
  if (text.size() <= kLongestDigits) return text;
  std::string out;
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    if (all[at] == ' ') {
      out += all[at++];
      continue;
    }
    const std::size_t word_end = end_of_word(all, at);
    if (word_end - at > kLongestWord) {
      out += beginning(all.substr(at, word_end - at), kLongestDigits);
      at = word_end;
      continue;
    }
    while (at < word_end) {
      const std::size_t end = end_of_run(all, at);
      const std::string_view run = all.substr(at, end - at);
      out += is_digit(run[0]) && run.size() > kLongestDigits ? beginning(run, kLongestDigits / 2)
                                                             : std::string(run);
      at = end;
    }
  }
  return out;
}

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

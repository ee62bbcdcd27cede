#include "parser/reading/rs274/plain_block.hpp"

#include <array>
#include <charconv>
#include <cstdint>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

// Room for the words of most blocks, so that they are allocated once.
constexpr std::size_t kWordsOfAPlainBlock = 8;

constexpr std::array kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
std::uint64_t digit_of(char c) { return static_cast<std::uint64_t>(c - '0'); }

class PlainReader {
 public:
  PlainReader(std::string_view text, LetterSet letters) : text_(text), letters_(letters) {}

  // Whether all of the text is plain.
  bool read(Block& block) {
    block.deletable = take('/');
    if (upper(peek()) == 'N') {
      ++place_;
      if (!read_block_number(block)) return false;
      block.deletable = take('/') || block.deletable;
    }
    block.words.reserve(kWordsOfAPlainBlock);
    while (peek() != 0) {
      if (!read_word(block)) return false;
    }
    return place_ == text_.size();
  }

 private:
  bool read_block_number(Block& block) {
    (void)peek();
    std::uint32_t number = 0;
    const auto read = std::from_chars(text_.data() + place_, text_.data() + text_.size(), number);
    if (read.ec != std::errc{}) return false;
    place_ = static_cast<std::size_t>(read.ptr - text_.data());
    block.number = number;
    return true;
  }

  bool read_word(Block& block) {
    const char letter = upper(text_[place_]);
    if (letter < 'A' || letter > 'Z' || !letters_.has(letter)) return false;
    Word word;
    word.letter = letter;
    word.column = static_cast<std::uint32_t>(++place_);
    const bool negative = take('-');
    if (!negative) take('+');
    (void)peek();
    if (!read_number(word)) return false;
    // The sum turns -0 into 0.
    word.number = (negative ? -word.number : word.number) + 0.0;
    block.words.push_back(word);
    return true;
  }

  // Without a sign. Up to 15 digits are a whole number without loss, which one division by a power
  // of ten rounds as the decimal number is.
  bool read_number(Word& word) {
    const char* const start = text_.data() + place_;
    const char* const end = text_.data() + text_.size();
    const char* at = start;
    std::uint64_t digits = 0;
    for (; at != end && is_digit(*at); ++at) digits = 10 * digits + digit_of(*at);
    word.decimal_point = at != end && *at == '.';
    std::size_t decimals = 0;
    if (word.decimal_point) {
      const char* const behind_point = ++at;
      for (; at != end && is_digit(*at); ++at) digits = 10 * digits + digit_of(*at);
      decimals = static_cast<std::size_t>(at - behind_point);
    }
    const auto length = static_cast<std::size_t>(at - start);
    place_ += length;
    if (length < kPowersOfTen.size()) {
      if (length == (word.decimal_point ? 1U : 0U)) return false;
      word.number = static_cast<double>(digits) / kPowersOfTen[decimals];
      return true;
    }
    return std::from_chars(start, at, word.number).ec == std::errc{};
  }

  [[nodiscard]] char at_place() const { return place_ < text_.size() ? text_[place_] : '\0'; }
  // The next character that is not blank; 0 at the end.
  char peek() {
    while (at_place() == ' ' || at_place() == '\t' || at_place() == '\r') ++place_;
    return at_place();
  }
  bool take(char expected) {
    if (peek() != expected) return false;
    ++place_;
    return true;
  }

  std::string_view text_;
  LetterSet letters_;
  std::size_t place_ = 0;
};

}  // namespace

std::optional<Block> read_plain_block(std::string_view text, std::uint32_t line,
                                      LetterSet letters) {
  std::optional<Block> block(std::in_place);
  block->line = line;
  if (!PlainReader(text, letters).read(*block)) block.reset();
  return block;
}

}  // namespace frustum::parser

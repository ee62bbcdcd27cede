#include "parser/reading/rs274/plain_block.hpp"

#include <charconv>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

// Room for the words of most blocks, so that they are allocated once.
constexpr std::size_t kWordsOfAPlainBlock = 8;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class PlainReader {
 public:
  explicit PlainReader(std::string_view text) : text_(text) {}

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
    if (letter < 'A' || letter > 'Z' || letter == 'N' || letter == 'O') return false;
    Word word;
    word.letter = letter;
    word.column = static_cast<std::uint32_t>(++place_);
    const bool negative = take('-');
    if (!negative) take('+');
    (void)peek();
    const std::size_t start = place_;
    while (is_digit(at_place())) ++place_;
    word.decimal_point = at_place() == '.';
    if (word.decimal_point) {
      ++place_;
      while (is_digit(at_place())) ++place_;
    }
    const auto read = std::from_chars(text_.data() + start, text_.data() + place_, word.number);
    if (read.ec != std::errc{}) return false;
    // The sum turns -0 into 0.
    word.number = (negative ? -word.number : word.number) + 0.0;
    block.words.push_back(word);
    return true;
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
  std::size_t place_ = 0;
};

}  // namespace

std::optional<Block> read_plain_block(std::string_view text, std::uint32_t line) {
  std::optional<Block> block(std::in_place);
  block->line = line;
  if (!PlainReader(text).read(*block)) block.reset();
  return block;
}

}  // namespace frustum::parser

#include "parser/reading/rs274/plain_block.hpp"

#include <charconv>
#include <cstdint>

#include "parser/language/letter_case.hpp"
#include "parser/reading/plain_number.hpp"

namespace frustum::parser {
namespace {

// Room for the words of most blocks, so that they are allocated once.
constexpr std::size_t kWordsOfAPlainBlock = 8;

class PlainReader {
 public:
  PlainReader(std::string_view text, LetterSet letters)
      : start_(text.data()), at_(start_), end_(start_ + text.size()), letters_(letters) {}

  // Whether all of the text is plain.
  bool read(Block& block) {
    block.deletable = take('/');
    block.number.reset();
    block.words.clear();
    block.words.reserve(kWordsOfAPlainBlock);
    if (upper(peek()) == 'N') {
      ++at_;
      if (!read_block_number(block)) return false;
      block.deletable = take('/') || block.deletable;
    }
    while (peek() != 0) {
      if (!read_word(block)) return false;
    }
    return at_ == end_;
  }

 private:
  bool read_block_number(Block& block) {
    (void)peek();
    std::uint32_t number = 0;
    const auto read = std::from_chars(at_, end_, number);
    if (read.ec != std::errc{}) return false;
    at_ = read.ptr;
    block.number = number;
    return true;
  }

  bool read_word(Block& block) {
    const char letter = upper(*at_);
    if (letter < 'A' || letter > 'Z' || !letters_.has(letter)) return false;
    ++at_;
    const auto column = static_cast<std::uint32_t>(at_ - start_);
    const bool negative = take('-');
    if (!negative) take('+');
    (void)peek();
    const auto number = read_plain_number(at_, end_);
    if (!number) return false;
    at_ = number->end;
    Word& word = block.words.emplace_back();
    word.letter = letter;
    word.decimal_point = number->decimal_point;
    word.column = column;
    // The sum turns -0 into 0.
    word.number = (negative ? -number->value : number->value) + 0.0;
    return true;
  }

  // The next character that is not blank; 0 at the end.
  char peek() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')) ++at_;
    return at_ == end_ ? '\0' : *at_;
  }
  bool take(char expected) {
    if (peek() != expected) return false;
    ++at_;
    return true;
  }

  const char* start_;
  const char* at_;
  const char* end_;
  LetterSet letters_;
};

}  // namespace

bool read_plain_block(Block& block, std::string_view text, std::uint32_t line, LetterSet letters) {
  block.line = line;
  return PlainReader(text, letters).read(block);
}

}  // namespace frustum::parser

// Reads a block of text by hand, where a dialect's words are few: names, numbers, signs, comments.
//
// The first failure sticks: from then on everything is at its end, so that readers need to look
// only once. Letters count as upper case. Blanks are skipped before each token; a line feed,
// between the lines of one block, is a blank.
// Units: none; values are as written. Columns count bytes from 1 over all lines of the block.
// Errors: a number that is missing or too large; those of the reader, by fail().
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/block.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::parser {

struct ScannedNumber {
  double value = 0.0;
  bool decimal_point = false;
};

class LineScanner {
 public:
  LineScanner(std::string_view text, std::uint32_t line);

  // Numbers may have a comma for a decimal point: 1,5.
  void read_decimal_commas() { decimal_commas_ = true; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool at_end();
  // The next character that is not blank, in upper case; 0 at the end.
  [[nodiscard]] char peek() {
    if (failed()) return 0;
    skip_blanks();
    return peek_byte();
  }
  // Like peek(), but of the very next byte.
  [[nodiscard]] char peek_byte() const {
    return failed() || place_ >= text_.size() ? '\0' : upper(text_[place_]);
  }
  bool take(char expected);
  // All characters of the sign, or none.
  bool take_sign(std::string_view expected);
  // The same without blanks between them, letters of either case.
  bool take_bytes(std::string_view expected);
  // The whole name when it is `expected`.
  bool take_name(std::string_view expected);
  // A run of letters, in upper case; empty when there is none.
  [[nodiscard]] std::string letters();
  // A letter or _, then letters, digits, _.
  [[nodiscard]] std::string name();
  // What name() would return.
  [[nodiscard]] std::string next_name();
  [[nodiscard]] std::string_view digits();
  // A decimal number without a sign; nothing is taken when there is none.
  [[nodiscard]] std::optional<ScannedNumber> number();
  // The same of digits alone.
  [[nodiscard]] std::optional<double> whole_number();
  // The number of a block or program: up to 8 digits.
  [[nodiscard]] std::optional<std::uint32_t> block_number();
  // The decimals of a block number, which count for nothing.
  void skip_decimals();
  // [ + | - ] number; `whose` has no number when there is none.
  [[nodiscard]] double signed_number(std::string_view whose, std::uint32_t whose_column);
  // To the end of the line, or up to one of `stops`; blanks at both ends are left out.
  [[nodiscard]] std::string text_to(std::string_view stops = {});

  // The same with its blanks and as the bytes are.
  [[nodiscard]] std::string_view bytes_to(std::string_view stops = {});

  // Of the next token.
  [[nodiscard]] std::uint32_t column();
  void go_to(std::uint32_t column) { place_ = column - 1; }
  [[nodiscard]] bool failed() const { return failure_.has_value(); }
  void fail(DiagnosticId id, std::uint32_t column, std::string message, std::string hint);
  // One that knows its column.
  void fail(Diagnostic failure);
  void fail_unexpected(std::string hint);
  [[nodiscard]] const Diagnostic& failure() const { return *failure_; }
  // What comes next, as messages name it: "'x'", "byte 0x1A", "the end of the block".
  [[nodiscard]] std::string next_shown();
  // The block, or the failure.
  [[nodiscard]] Result<Block> finish(Block&& block) const;

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip_blanks() {
    while (place_ < text_.size() && is_blank(text_[place_])) ++place_;
  }
  [[nodiscard]] double value_of(std::string_view digits);

  std::string_view text_;
  std::uint32_t line_ = 0;
  std::size_t place_ = 0;
  bool decimal_commas_ = false;
  std::optional<Diagnostic> failure_{};
};

}  // namespace frustum::parser

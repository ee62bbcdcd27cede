#include "parser/reading/line_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "parser/reading/comment_text.hpp"
#include "parser/reading/syntax_error.hpp"

namespace frustum::parser {
namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

LineScanner::LineScanner(std::string_view text, std::uint32_t line) : text_(text), line_(line) {}

bool LineScanner::at_end() { return peek() == 0 && (failed() || place_ >= text_.size()); }

bool LineScanner::take(char expected) {
  if (peek() != expected || expected == 0) return false;
  ++place_;
  return true;
}

bool LineScanner::take_sign(std::string_view expected) {
  if (peek() != expected.front()) return false;
  const std::uint32_t start = column();
  for (const char c : expected) {
    if (take(c)) continue;
    go_to(start);
    return false;
  }
  return true;
}

bool LineScanner::take_bytes(std::string_view expected) {
  if (peek() != expected.front()) return false;
  const std::string_view found = text_.substr(place_, expected.size());
  const auto same = [](char wanted, char c) { return wanted == upper(c); };
  if (!std::equal(expected.begin(), expected.end(), found.begin(), found.end(), same)) return false;
  place_ += expected.size();
  return true;
}

bool LineScanner::take_name(std::string_view expected) {
  const std::uint32_t start = column();
  if (name() == expected) return true;
  go_to(start);
  return false;
}

std::string LineScanner::letters() {
  std::string run;
  for (char c = peek(); is_letter(c); c = peek_byte()) {
    run += c;
    ++place_;
  }
  return run;
}

std::string LineScanner::name() {
  std::string run;
  if (!is_letter(peek())) return run;
  for (char c = peek(); is_letter(c) || is_digit(c); c = peek_byte()) {
    run += c;
    ++place_;
  }
  return run;
}

std::string LineScanner::next_name() {
  const std::uint32_t start = column();
  std::string found = name();
  go_to(start);
  return found;
}

std::string_view LineScanner::digits() {
  if (at_end()) return {};
  const std::size_t start = place_;
  while (is_digit(peek_byte())) ++place_;
  return text_.substr(start, place_ - start);
}

std::optional<ScannedNumber> LineScanner::number() {
  if (at_end()) return std::nullopt;
  const std::size_t start = place_;
  const auto has_digits = [this] {
    const std::size_t first = place_;
    while (is_digit(peek_byte())) ++place_;
    return place_ > first;
  };
  bool any = has_digits();
  const bool comma = any && decimal_commas_ && peek_byte() == ',' && place_ + 1 < text_.size() &&
                     is_digit(text_[place_ + 1]);
  const bool point = comma || peek_byte() == '.';
  if (point) {
    ++place_;
    any = has_digits() || any;
  }
  if (!any) {
    place_ = start;
    return std::nullopt;
  }
  const std::string_view digits = text_.substr(start, place_ - start);
  if (!comma) return ScannedNumber{value_of(digits), point};
  std::string pointed(digits);
  pointed[pointed.find(',')] = '.';
  return ScannedNumber{value_of(pointed), point};
}

std::optional<double> LineScanner::whole_number() {
  const std::string_view found = digits();
  if (found.empty()) return std::nullopt;
  return value_of(found);
}

std::optional<std::uint32_t> LineScanner::block_number() {
  const std::uint32_t start = column();
  const std::string_view found = digits();
  if (found.empty()) return std::nullopt;
  std::uint32_t value = 0;
  const auto read = std::from_chars(found.data(), found.data() + found.size(), value);
  if (read.ec != std::errc{}) {
    fail("number-too-large"_id, start, "the number is too large",
         "N and O numbers have up to 8 digits");
  }
  return value;
}

void LineScanner::skip_decimals() {
  if (peek_byte() != '.') return;
  ++place_;
  while (is_digit(peek_byte())) ++place_;
}

// Of the digits before the place.
double LineScanner::value_of(std::string_view digits) {
  double value = 0.0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // Out of range is also what is too small, which is 0.
  if (read.ec == std::errc::result_out_of_range &&
      digits.find_first_of("123456789") < std::min(digits.find('.'), digits.size())) {
    fail("number-too-large"_id, static_cast<std::uint32_t>(place_ - digits.size() + 1),
         "the number is too large", "numbers go up to 1.8e308");
  }
  return value;
}

double LineScanner::signed_number(std::string_view whose, std::uint32_t whose_column) {
  const bool negative = take('-');
  if (!negative) take('+');
  const auto found = number();
  if (!found) {
    fail("value-missing"_id, whose_column, fmt::format("{} has no number", whose),
         fmt::format("write {} and a number", whose));
    return 0.0;
  }
  return (negative ? -found->value : found->value) + 0.0;
}

std::string_view LineScanner::bytes_to(std::string_view stops) {
  if (failed()) return {};
  const std::size_t start = place_;
  place_ = std::min(text_.find('\n', start), text_.size());
  if (!stops.empty()) place_ = std::min(text_.find_first_of(stops, start), place_);
  return text_.substr(start, place_ - start);
}

std::string LineScanner::text_to(std::string_view stops) {
  std::string_view found = bytes_to(stops);
  found.remove_prefix(std::min(found.find_first_not_of(" \t\r"), found.size()));
  found = found.substr(0, found.find_last_not_of(" \t\r") + 1);
  return utf8_of(found);
}

std::uint32_t LineScanner::column() {
  skip_blanks();
  return static_cast<std::uint32_t>(place_) + 1;
}

void LineScanner::fail(DiagnosticId id, std::uint32_t column, std::string message,
                       std::string hint) {
  if (failed()) return;
  failure_ = error(id, std::move(message), std::move(hint));
  failure_->column = static_cast<int>(column);
}

void LineScanner::fail(Diagnostic failure) {
  if (!failed()) failure_ = std::move(failure);
}

void LineScanner::fail_unexpected(std::string hint) {
  fail("unexpected-character"_id, column(), "unexpected " + next_shown(), std::move(hint));
}

std::string LineScanner::next_shown() {
  return at_end() ? "the end of the block" : printable(text_[place_]);
}

Result<Block> LineScanner::finish(Block&& block) const {
  if (!failed()) return std::move(block);
  // The lines of the block are not cut yet; count them here.
  Diagnostic diagnostic = *failure_;
  diagnostic.line = static_cast<int>(line_);
  const auto before =
      text_.substr(0, std::min(static_cast<std::size_t>(diagnostic.column) - 1, text_.size()));
  for (const char c : before) diagnostic.line += c == '\n' ? 1 : 0;
  if (const std::size_t feed = before.rfind('\n'); feed != std::string_view::npos) {
    diagnostic.column -= static_cast<int>(feed) + 1;
  }
  return diagnostic;
}

}  // namespace frustum::parser

#include "parser/reading/syntax_error.hpp"

#include <fmt/format.h>

#include <array>

namespace frustum::parser {
namespace {

// Where the diagnostic points.
enum class Place : std::uint8_t { stop, opening, word };
// Which stops a row is for.
enum class Stop : std::uint8_t { any, end, character };

struct Row {
  std::string_view expected;
  Stop stop;
  std::string_view characters;  // for Stop::character
  Place place;
  DiagnosticId id;
  const char* message;  // {letter}: of the word; {found}: the character at the stop
  const char* hint;
};

constexpr std::string_view kDigits = "0123456789.";

// The first row that fits speaks.
constexpr std::array kRows{
    Row{"value", Stop::any, "", Place::word, "value-missing"_id, "{letter} has no number",
        "give {letter} a number, a parameter (#1) or an expression in [ ]"},
    Row{"flow control", Stop::any, "", Place::word, "unknown-word"_id,
        "unknown word {letter}... after an O word",
        "O-word flow control (sub, while, if) is not read: write O1000 to M99 and call M98 P1000"},
    Row{"setting value", Stop::any, "", Place::word, "value-missing"_id,
        "the parameter setting has no value", "write #1=2.5 or #1=[#2+1]"},
    Row{"closing parenthesis", Stop::end, "", Place::opening, "comment-not-closed"_id,
        "the comment is not closed", "close it with ) on the same line"},
    Row{"closing parenthesis", Stop::any, "", Place::stop, "comment-in-comment"_id,
        "comment inside a comment", "use other brackets inside comments"},
    Row{"equals", Stop::any, "", Place::word, "keyword-missing"_id,
        "a parameter setting has no =", "write #1=value to set a parameter, X#1 to use one"},
    Row{"block number", Stop::any, "", Place::stop, "value-missing"_id, "N has no number",
        "write N and 1 to 8 digits, or leave it away"},
    Row{"program number", Stop::any, "", Place::stop, "name-missing"_id, "O has no number",
        "write O and the number of the program, for example O1000"},
    Row{"end of block", Stop::character, kDigits, Place::stop, "letter-missing"_id,
        "a number without a letter",
        "put a letter before it, for example X; a number has one decimal point and no blanks"},
    Row{"end of block", Stop::character, ")", Place::stop, "unexpected-character"_id,
        "unexpected )", "open the comment with ("},
    Row{"end of block", Stop::character, "]", Place::stop, "unexpected-character"_id,
        "unexpected ]", "open the expression with ["},
    Row{"end of block", Stop::character, "+-*[", Place::stop, "unexpected-character"_id,
        "unexpected {found} between words", "put expressions in [ ] after a letter: X[1+2]"},
    Row{"end of block", Stop::character, "nN", Place::stop, "word-order"_id,
        "N is not the first word", "put the block number at the start of the block"},
    Row{"end of block", Stop::character, "/", Place::stop, "unexpected-character"_id,
        "unexpected / between words",
        "block delete is at the start of the block; division is in [ ]"},
    Row{"end of block", Stop::character, "%", Place::stop, "unexpected-character"_id,
        "unexpected % inside a block", "% is alone on its line"},
    Row{"end of block", Stop::any, "", Place::stop, "unexpected-character"_id, "unexpected {found}",
        "a block consists of words such as G1 X10, settings such as #1=2, and comments in ( )"},
};

bool fits(const Row& row, const SyntaxFailure& failure) {
  if (row.expected != failure.expected) return false;
  const bool at_end = failure.offset >= failure.text.size();
  switch (row.stop) {
    case Stop::end:
      return at_end;
    case Stop::character:
      return !at_end && row.characters.find(failure.text[failure.offset]) != std::string_view::npos;
    case Stop::any:
      return true;
  }
  return false;
}

std::uint32_t column_of(const Row& row, const SyntaxFailure& failure) {
  if (row.place == Place::opening && failure.opening_column > 0) return failure.opening_column;
  if (row.place == Place::word && failure.word_column > 0) return failure.word_column;
  return static_cast<std::uint32_t>(failure.offset) + 1;
}

}  // namespace

std::string printable(char character) {
  const auto code = static_cast<unsigned char>(character);
  if (code >= 0x20 && code < 0x7F) return fmt::format("'{}'", character);
  return fmt::format("byte 0x{:02X}", code);
}

Diagnostic describe(const SyntaxFailure& failure) {
  const bool at_end = failure.offset >= failure.text.size();
  const std::string found = at_end ? "the end" : printable(failure.text[failure.offset]);
  for (const Row& row : kRows) {
    if (!fits(row, failure)) continue;
    const auto worded = [&](const char* pattern) {
      return fmt::format(fmt::runtime(pattern), fmt::arg("letter", failure.word_letter),
                         fmt::arg("found", found));
    };
    Diagnostic diagnostic = error(row.id, worded(row.message), worded(row.hint));
    diagnostic.column = static_cast<int>(column_of(row, failure));
    return diagnostic;
  }
  Diagnostic diagnostic = error("unexpected-character"_id, "unexpected " + found,
                                "expected " + std::string(failure.expected));
  diagnostic.column = static_cast<int>(failure.offset) + 1;
  return diagnostic;
}

}  // namespace frustum::parser

#include "parser/reading/block_reader.hpp"

#include <algorithm>
#include <string>

#include "parser/language/letter_case.hpp"
#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/heidenhain/plain_line.hpp"
#include "parser/reading/rs274/grammar.hpp"
#include "parser/reading/rs274/macro_reader.hpp"
#include "parser/reading/rs274/o_word_reader.hpp"
#include "parser/reading/rs274/plain_block.hpp"

namespace frustum::parser {
namespace {

// PPRINT COSTS 5 $
bool is_text_record(std::string_view line) {
  std::string word;
  for (const char c : line.substr(std::min(line.find_first_not_of(" \t"), line.size()))) {
    if (upper(c) < 'A' || upper(c) > 'Z') break;
    word += upper(c);
  }
  return cldata_text_word(word) != nullptr;
}

}  // namespace

BlockReader reader_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::fanuc:
      return read_fanuc_block;
    case Dialect::linuxcnc:
      return read_linuxcnc_block;
    case Dialect::sinumerik:
      return read_sinumerik_block;
    case Dialect::heidenhain:
      return heidenhain_reader();
    case Dialect::cldata:
      return cldata_reader();
  }
  return [](std::string_view text, std::uint32_t line) { return parse_block(text, line); };
}

PlainBlockReader plain_reader_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::sinumerik:
      return read_plain_sinumerik_block;
    case Dialect::heidenhain:
      return read_plain_line;
    case Dialect::cldata:
      return nullptr;
    case Dialect::fanuc:
    case Dialect::linuxcnc:
      break;
  }
  return [](Block& block, std::string_view text, std::uint32_t line) {
    return read_plain_block(block, text, line);
  };
}

std::size_t continuation_mark(std::string_view line, Dialect dialect) {
  constexpr std::string_view kBlanks = " \t\r";
  if (dialect == Dialect::heidenhain) {
    const std::size_t last = line.find_last_not_of(kBlanks);
    return last != std::string_view::npos && line[last] == '~' ? last : std::string_view::npos;
  }
  if (dialect != Dialect::cldata) return std::string_view::npos;
  // A $ continues the statement, also before a comment; $$ begins one.
  const std::size_t mark = line.find('$');
  if (mark == std::string_view::npos || line.substr(mark).starts_with("$$")) {
    return std::string_view::npos;
  }
  return is_text_record(line) ? std::string_view::npos : mark;
}

bool opens_parameter_lines(std::string_view line, Dialect dialect) {
  if (dialect != Dialect::heidenhain) return false;
  line = line.substr(std::min(line.find_first_not_of("0123456789 \t"), line.size()));
  if (line.size() < 4 || upper(line[0]) != 'C' || upper(line[1]) != 'Y') return false;
  line = line.substr(0, line.find(';'));
  // Three digits: the cycles whose parameters are Q.
  const std::size_t digit = std::min(line.find_first_of("0123456789"), line.size());
  const std::size_t end = std::min(line.find_first_not_of("0123456789", digit), line.size());
  // CYCL DEF, not CYCL CALL POS X+100 nor CYCL CALL F100.
  const std::size_t word = line.substr(0, digit).find_last_not_of(" \t");
  const std::string_view before = line.substr(0, word == std::string_view::npos ? 0 : word + 1);
  const bool defines = before.size() > 3 && upper(before[before.size() - 3]) == 'D' &&
                       upper(before[before.size() - 2]) == 'E' && upper(before.back()) == 'F';
  return defines && end - digit == 3 && line.find('=') == std::string_view::npos;
}

bool is_parameter_line(std::string_view line) {
  line = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
  if (line.empty() || upper(line[0]) != 'Q') return false;
  const std::size_t end = line.find_first_not_of("0123456789", 1);
  // Cycles of three digits have none below Q200.
  constexpr std::size_t kThreeDigits = 4;
  if (end == std::string_view::npos || end < kThreeDigits || line[1] < '2') return false;
  const std::size_t sign = line.find_first_not_of(" \t", end);
  return sign != std::string_view::npos && line[sign] == '=';
}

}  // namespace frustum::parser

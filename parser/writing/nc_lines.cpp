#include "parser/writing/nc_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {

std::string filled(std::string_view pattern, char hole, std::string_view with) {
  std::string text;
  for (const char c : pattern) {
    if (c == hole) {
      text += with;
    } else {
      text += c;
    }
  }
  return text;
}

void NcLines::begin(std::uint32_t source_line) {
  source_line_ = source_line;
  begun_ = true;
}

// What is written next belongs to the block of the last line.
bool NcLines::goes_on() const {
  return options_.layout == NcLayout::as_given && begun_ && source_line_ != 0 &&
         !program_.source_lines.empty() && program_.source_lines.back() == source_line_;
}

void NcLines::comment(std::string_view text) {
  line(fmt::format("{}{}{}", spelling_.comment_open, as_comment(text), spelling_.comment_close),
       BlockPart::comment);
}

std::string NcLines::as_comment(std::string_view text) const {
  const bool capitals = spelling_.upper_comments && options_.layout != NcLayout::as_given;
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '(' || c == '{') {
      shown += '[';
    } else if (c == ')' || c == '}') {
      shown += ']';
    } else if (c == '"') {
      shown += '\'';
    } else if (byte < 0x80 && std::isprint(byte) != 0) {
      shown += capitals ? upper(c) : c;
    } else if ((byte & 0xC0U) != 0x80U) {  // one sign for a character of several bytes
      shown += byte == '\t' ? ' ' : '?';
    }
  }
  while (!shown.empty() && shown.back() == ' ') shown.pop_back();
  return shown;
}

void NcLines::lines(std::string_view text, BlockPart part) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) line(text.substr(0, end), part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void NcLines::line(std::string_view text, BlockPart part) {
  std::string& program = program_.text;
  if (goes_on()) {
    program.pop_back();  // the line feed
    if (part == BlockPart::front) {
      program.insert(block_, fmt::format("{} ", text));
    } else {
      program += fmt::format(" {}", text);
    }
  } else {
    if (spelling_.numbered_blocks) program += fmt::format("{} ", program_.source_lines.size());
    block_ = program.size();
    program += text;
    program_.source_lines.push_back(source_line_);
  }
  if (part != BlockPart::comment && options_.source_lines && source_line_ != 0) {
    program +=
        fmt::format(" {}{}{}", spelling_.comment_open, source_line_, spelling_.comment_close);
  }
  program += '\n';
  begun_ = false;
}

LineRange lines_from(const NcProgram& program, LineRange source) {
  LineRange range;
  for (std::size_t i = 0; i < program.source_lines.size(); ++i) {
    const std::uint32_t from = program.source_lines[i];
    if (from < source.first || from > source.last) continue;
    range.last = static_cast<std::uint32_t>(i + 1);
    if (range.first == 0) range.first = range.last;
  }
  return range;
}

}  // namespace frustum::parser

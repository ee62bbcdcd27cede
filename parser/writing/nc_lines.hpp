// The lines of an NC program while it is written: numbered and commented as its dialect does, each
// with the line of the source that it came from.
//
// Units : as written
// Errors: none
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parser/writing/motion_spelling.hpp"

namespace frustum::parser {

// Where a dialect leaves the choice.
enum class NcLayout : std::uint8_t {
  brief,  // a block for each thing said; what is in force already is left out
  // Blocks and words as the motions give them: motions of one source line are one block, with a
  // comment among them at its end; each axis word is written; the motion word is written again
  // after a comment and a change of frame. The first comment is the title, those that follow it are
  // before the modes, and a motion without a source line is what the modes say. Comments keep small
  // letters.
  as_given
};

struct WriterOptions {
  std::string name = "FRUSTUM";  // of the program, where dialects name it
  std::string number = "1001";   // where they number it
  NcLayout layout = NcLayout::brief;
  bool restate_feed = false;  // F whenever cutting begins, not only where it changes
  bool comments = true;
  bool source_lines = false;  // a comment after each block: the line of the program it came from
  int length_decimals = 6;
  int angle_decimals = 7;
  int vector_decimals = 10;
  int feed_digits = 9;  // significant
};

struct NcProgram {
  std::string text{};
  // Of each line of the text, the line of the program it came from; 0: from none.
  std::vector<std::uint32_t> source_lines{};
};

// Lines of the text that came from lines first .. last of the source, both included; {0, 0} if
// none.
struct LineRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};
[[nodiscard]] LineRange lines_from(const NcProgram& program, LineRange source);

// `pattern` with `with` in the place of each `hole`.
[[nodiscard]] std::string filled(std::string_view pattern, char hole, std::string_view with);

// Where a text belongs in its block.
enum class BlockPart : std::uint8_t { front, rest, comment };

class NcLines {
 public:
  NcLines(const NcSpelling& spelling, const WriterOptions& options)
      : spelling_(spelling), options_(options) {}

  // What follows came from this line of the source; 0: from none.
  void begin(std::uint32_t source_line);
  // Each line of the text; nothing for an empty one.
  void lines(std::string_view text, BlockPart part = BlockPart::rest);
  void line(std::string_view text, BlockPart part = BlockPart::rest);
  void comment(std::string_view text);
  // Only what every controller shows in a comment.
  [[nodiscard]] std::string as_comment(std::string_view text) const;
  [[nodiscard]] NcProgram take() { return std::move(program_); }

 private:
  [[nodiscard]] bool goes_on() const;

  const NcSpelling& spelling_;
  const WriterOptions& options_;
  NcProgram program_{};
  std::uint32_t source_line_ = 0;
  bool begun_ = false;     // nothing was written since begin()
  std::size_t block_ = 0;  // where the last block begins in the text
};

}  // namespace frustum::parser

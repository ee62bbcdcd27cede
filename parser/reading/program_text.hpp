// The text of a program: in memory, or in a file that need not fit there, which is why it is not
// core/whole_file.hpp that reads it.
//
// Lines end with LF, CR LF or LF CR, in any mixture; in a text whose first 64 KiB have no LF they
// end with CR. Any other CR is within its line, a blank there. A byte order mark at the start is
// left out.
// Units  : offsets count bytes from the start of the text, lines from 1
// Shape  : a ProgramText is shared by any number of LineReaders, each with its own window over a
//          file; of a pipe, which can be read only once, the text is kept in memory
// Errors : open() of a file or pipe that cannot be read; a file that cannot be read on ends there
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum::parser {

class ProgramText {
 public:
  ProgramText() = default;
  explicit ProgramText(std::string text)
      : text_(std::make_shared<const std::string>(std::move(text))) {}
  // Shared with others, or of somebody who keeps it for as long as it is read.
  explicit ProgramText(std::shared_ptr<const std::string> text) : text_(std::move(text)) {}
  // A file, a pipe, or "-" for the standard input.
  [[nodiscard]] static Result<ProgramText> open(const std::filesystem::path& file);

  // The first bytes, at most `count`: what recognising a dialect looks at.
  [[nodiscard]] std::string head(std::size_t count) const;

 private:
  friend class LineReader;
  std::shared_ptr<const std::string> text_ = std::make_shared<const std::string>();
  std::filesystem::path file_{};  // when the text is not in memory
};

// Where a line begins.
struct TextPlace {
  std::uint64_t offset = 0;
  std::uint32_t line = 1;

  bool operator==(const TextPlace&) const = default;
};

class LineReader {
 public:
  explicit LineReader(ProgramText text);

  // Of the line that next() gives.
  [[nodiscard]] TextPlace place() const { return place_; }
  void go_to(TextPlace place);
  [[nodiscard]] bool at_end();
  // Without its end; valid until the next call. Empty at the end.
  [[nodiscard]] std::string_view next();

 private:
  [[nodiscard]] std::string_view rest() const { return window_.substr(in_window_); }
  // More of the file after what the window has left; false at its end.
  bool refill();
  void take(std::size_t bytes);

  ProgramText text_;
  std::ifstream file_{};
  std::string buffer_{};       // of a file; the window is its front
  std::string_view window_{};  // of the buffer, or the whole text
  std::size_t in_window_ = 0;  // where `place_` is in the window
  bool file_ended_ = true;
  bool carriages_end_ = false;  // a line of their own
  bool after_feed_ = false;     // the last line ended with LF: a CR now belongs to that end
  TextPlace place_{};
};

}  // namespace frustum::parser

// Reads a program block by block, from any place on.
//
// Units : as written
// Shape : one cursor a reader; the program is shared. Blocks that the program has are given as they
//         are, others are read from its text
// Errors: the syntax error of a block, with file, line and column; the cursor is then after it
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "parser/program.hpp"
#include "parser/reading/block_reader.hpp"

namespace frustum::parser {

class BlockCursor {
 public:
  explicit BlockCursor(const Program& program);

  // Where the next block is looked for.
  [[nodiscard]] TextPlace place() const { return kept_ ? place_ : lines_.place(); }
  void go_to(TextPlace place);
  // Where the block that next() gave begins.
  [[nodiscard]] TextPlace block_place() const { return block_place_; }

  [[nodiscard]] bool at_end() { return kept_ ? next_kept_ == kept_->size() : lines_.at_end(); }
  // The next block that is not blank, valid until the next call; null at the end of the text.
  [[nodiscard]] Result<const Block*> next();
  // The block that next() has read from the text, to keep.
  [[nodiscard]] Block take() { return std::move(is_plain_ ? plain_block_ : block_); }

 private:
  // The text of one block, lines that continue it joined by line feeds.
  [[nodiscard]] std::string_view next_text(std::vector<std::uint32_t>& line_starts);

  // Of a cycle whose parameters follow in lines of their own, without a mark.
  [[nodiscard]] std::string_view with_parameter_lines(std::string_view text,
                                                      std::vector<std::uint32_t>& line_starts);

  // Of a program that has been read.
  std::shared_ptr<const std::vector<ReadBlock>> kept_;
  std::size_t next_kept_ = 0;
  TextPlace place_{};

  std::string file_;
  Dialect dialect_;
  LineReader lines_;
  BlockReader read_;
  PlainBlockReader read_plain_;
  std::string joined_{};
  TextPlace block_place_{};
  Block block_{};
  Block plain_block_{};    // of the plain reader alone
  bool is_plain_ = false;  // the last block
};

}  // namespace frustum::parser

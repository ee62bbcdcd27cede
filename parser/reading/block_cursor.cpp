#include "parser/reading/block_cursor.hpp"

#include <algorithm>

namespace frustum::parser {

BlockCursor::BlockCursor(const Program& program)
    : kept_(program.blocks),
      file_(program.file),
      dialect_(program.dialect),
      lines_(program.text),
      read_(reader_of(program.dialect)),
      read_plain_(plain_reader_of(program.dialect)) {}

void BlockCursor::go_to(TextPlace place) {
  if (!kept_) return lines_.go_to(place);
  place_ = place;
  const auto found = std::lower_bound(
      kept_->begin(), kept_->end(), place.offset,
      [](const ReadBlock& block, std::uint64_t offset) { return block.place.offset < offset; });
  next_kept_ = static_cast<std::size_t>(found - kept_->begin());
}

std::string_view BlockCursor::next_text(std::vector<std::uint32_t>& line_starts) {
  std::string_view text = lines_.next();
  std::size_t mark = continuation_mark(text, dialect_);
  joined_.clear();
  if (mark == std::string_view::npos && opens_parameter_lines(text, dialect_)) {
    return with_parameter_lines(text, line_starts);
  }
  if (mark == std::string_view::npos) return text;
  while (true) {
    const std::size_t start = joined_.size();
    joined_ += text;
    if (mark == std::string_view::npos || lines_.at_end()) return joined_;
    // What follows the mark on its line is a remark.
    std::fill(joined_.begin() + static_cast<std::ptrdiff_t>(start + mark), joined_.end(), ' ');
    joined_ += '\n';
    line_starts.push_back(static_cast<std::uint32_t>(joined_.size()));
    text = lines_.next();
    mark = continuation_mark(text, dialect_);
  }
}

std::string_view BlockCursor::with_parameter_lines(std::string_view text,
                                                   std::vector<std::uint32_t>& line_starts) {
  joined_ = text;
  while (!lines_.at_end()) {
    const TextPlace here = lines_.place();
    const std::string_view next = lines_.next();
    if (!is_parameter_line(next)) {
      lines_.go_to(here);
      break;
    }
    joined_ += '\n';
    line_starts.push_back(static_cast<std::uint32_t>(joined_.size()));
    const std::size_t start = joined_.size();
    joined_ += next;
    const std::size_t mark = continuation_mark(next, dialect_);
    if (mark == std::string_view::npos) continue;
    std::fill(joined_.begin() + static_cast<std::ptrdiff_t>(start + mark), joined_.end(), ' ');
  }
  return joined_;
}

Result<const Block*> BlockCursor::next() {
  if (kept_) {
    if (next_kept_ == kept_->size()) return static_cast<const Block*>(nullptr);
    const ReadBlock& block = (*kept_)[next_kept_++];
    block_place_ = block.place;
    place_ = block.after;
    return &block.block;
  }
  while (!lines_.at_end()) {
    block_place_ = lines_.place();
    std::vector<std::uint32_t> line_starts;
    const std::string_view text = next_text(line_starts);
    is_plain_ = read_plain_ != nullptr && read_plain_(plain_block_, text, block_place_.line);
    if (is_plain_) {
      if (plain_block_.empty()) continue;
      return &plain_block_;
    }
    auto block = read_(text, block_place_.line);
    if (!block) {
      Diagnostics failures = std::move(block).error();
      for (Diagnostic& failure : failures) failure.file = file_;
      return failures;
    }
    if (block->empty()) continue;
    block_ = *std::move(block);
    block_.line_starts = std::move(line_starts);
    return &block_;
  }
  return static_cast<const Block*>(nullptr);
}

}  // namespace frustum::parser

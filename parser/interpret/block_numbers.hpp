// Where the block numbers of a program are, for jumps: the text is read once, not once a jump.
//
// Units : none
// Shape : 24 bytes a numbered block
// Errors: none; blocks with a syntax error have no number
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "parser/program.hpp"

namespace frustum::parser {

class BlockNumbers {
 public:
  explicit BlockNumbers(const Program& program);

  // The first block of that number from the offset `from` on and before `end`, in the program of
  // the file that begins at `start`: the next one has numbers of its own.
  [[nodiscard]] std::optional<TextPlace> find(std::uint32_t number, std::uint64_t from,
                                              std::uint64_t end, std::uint64_t start) const;

 private:
  struct Numbered {
    std::uint32_t number;
    TextPlace place;
  };
  std::vector<Numbered> numbers_{};              // by number, then place
  std::vector<std::uint64_t> program_starts_{};  // offsets of the O words
};

}  // namespace frustum::parser

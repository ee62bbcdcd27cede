#include "parser/interpret/block_numbers.hpp"

#include <algorithm>
#include <tuple>

#include "parser/reading/block_cursor.hpp"

namespace frustum::parser {

BlockNumbers::BlockNumbers(const Program& program) {
  BlockCursor cursor(program);
  while (true) {
    const auto block = cursor.next();
    if (!block) continue;
    if (*block == nullptr) break;
    const TextPlace place = cursor.block_place();
    // The next program of the file has numbers of its own.
    if ((*block)->program || (*block)->tape_mark) program_starts_.push_back(place.offset);
    if ((*block)->number) numbers_.push_back({*(*block)->number, place});
  }
  std::sort(numbers_.begin(), numbers_.end(), [](const Numbered& a, const Numbered& b) {
    return std::tie(a.number, a.place.offset) < std::tie(b.number, b.place.offset);
  });
}

std::optional<TextPlace> BlockNumbers::find(std::uint32_t number, std::uint64_t from,
                                            std::uint64_t end, std::uint64_t start) const {
  const auto next_program =
      std::lower_bound(program_starts_.begin(), program_starts_.end(), std::max(from, start + 1));
  if (next_program != program_starts_.end()) end = std::min(end, *next_program);
  const auto found =
      std::lower_bound(numbers_.begin(), numbers_.end(), std::tie(number, from),
                       [](const Numbered& numbered, const auto& wanted) {
                         return std::tie(numbered.number, numbered.place.offset) < wanted;
                       });
  if (found == numbers_.end() || found->number != number || found->place.offset >= end) {
    return std::nullopt;
  }
  return found->place;
}

}  // namespace frustum::parser

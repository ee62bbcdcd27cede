// Lines of files, each counted once, however often a program runs over it.
//
// Units : none
// Shape : a bit for each line of the neighbourhoods that have one
// Errors: none
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>

#include "parser/motion.hpp"

namespace frustum::lint {

class LineSet {
 public:
  // Whether the line is new.
  bool insert(const parser::SourcePlace& place) {
    const std::uint64_t file = place.file ? std::hash<std::string>()(*place.file) : 0;
    std::uint64_t& lines = lines_[(file << 32U) ^ (place.line / kBits)];
    const std::uint64_t bit = std::uint64_t{1} << (place.line % kBits);
    const bool fresh = (lines & bit) == 0;
    lines |= bit;
    return fresh;
  }
  [[nodiscard]] std::uint64_t size() const {
    std::uint64_t count = 0;
    for (const auto& [at, lines] : lines_)
      count += static_cast<std::uint64_t>(std::popcount(lines));
    return count;
  }

 private:
  static constexpr std::uint32_t kBits = 64;

  std::unordered_map<std::uint64_t, std::uint64_t> lines_{};
};

}  // namespace frustum::lint

// Random blocks as the grammar of RS-274 may produce them: words, settings, comments.
//
// Randomness is keyed by the seed alone, so that a failure names the program that caused it.
#pragma once

#include <cstdint>
#include <vector>

#include "parser/program.hpp"

namespace frustum::parser {

// A stream of random choices.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}

  // A whole number in [0, end).
  [[nodiscard]] std::size_t below(std::size_t end);
  [[nodiscard]] bool chance(double probability);
  // Numbers as programs have them: whole, with decimals, tiny, huge.
  [[nodiscard]] double number();

 private:
  double next();

  std::uint64_t seed_;
  std::uint64_t index_ = 0;
};

// Of Fanuc or LinuxCNC.
[[nodiscard]] std::vector<Block> random_blocks(std::uint64_t seed, Dialect dialect);

}  // namespace frustum::parser

// Random programs as the grammar may produce them, and whether two blocks say the same.
//
// Randomness is keyed by the seed alone, so that a failure names the program that caused it.
#pragma once

#include <cstdint>
#include <string>
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

[[nodiscard]] std::vector<Block> random_blocks(std::uint64_t seed);

// Equal but for columns, and for how names and expressions are numbered.
[[nodiscard]] bool same_block(const Block& a, const Block& b);

}  // namespace frustum::parser

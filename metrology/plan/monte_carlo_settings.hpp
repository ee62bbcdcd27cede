// How often a Monte Carlo simulation of measuring errors is drawn.
//
// Units  : none
// Errors : read_monte_carlo notes mistakes in the table's document
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/toml_document.hpp"

namespace frustum::metrology {

// Draws come in blocks: 100 / (1 - 95 %), the least that tells the ends of the interval.
inline constexpr std::size_t kBlockOfDraws = 2000;

struct MonteCarloSettings {
  std::optional<std::size_t> draws{};  // rounded up to blocks; absent: until stable
  int digits = 1;  // of the standard uncertainty that have to stand still: 1 or 2
  std::uint64_t seed = 1;

  bool operator==(const MonteCarloSettings&) const = default;
};

// { method = "monte_carlo", draws = "adaptive", digits = 1, seed = 1 }; draws may be a number;
// nothing for method = "linear", which takes no other key.
[[nodiscard]] std::optional<MonteCarloSettings> read_monte_carlo(const TomlTable& table);
// The same as text.
[[nodiscard]] std::string to_toml(const MonteCarloSettings& settings);

}  // namespace frustum::metrology

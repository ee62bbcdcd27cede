#include "metrology/plan/monte_carlo_settings.hpp"

#include <fmt/format.h>

namespace frustum::metrology {

std::optional<MonteCarloSettings> read_monte_carlo(const TomlTable& table) {
  MonteCarloSettings settings;
  if (table.choice("method", {"monte_carlo", "linear"}) == 1) {
    for (const char* key : {"draws", "digits", "seed"}) {
      if (!table.has(key)) continue;
      table.fail(key, "monte-carlo-settings"_id,
                 "belongs to method = \"monte_carlo\": linear propagation draws nothing",
                 "leave it out, or write method = \"monte_carlo\"");
    }
    return std::nullopt;
  }
  if (table.is_number("draws")) {
    const std::int64_t draws = table.integer("draws", Bound::positive);
    // Ten million draws of a plan take the better part of an hour.
    if (draws > 10000000) {
      table.fail("draws", "monte-carlo-settings"_id,
                 fmt::format("must be at most 10000000, is {}", draws));
    }
    settings.draws = static_cast<std::size_t>(draws);
  } else {
    static_cast<void>(table.choice_or("draws", {"adaptive"}, 0));
  }
  const std::int64_t digits = table.integer_or("digits", settings.digits, Bound::positive);
  if (digits > 2)
    table.fail("digits", "monte-carlo-settings"_id, fmt::format("must be 1 or 2, is {}", digits));
  settings.digits = static_cast<int>(digits == 1 ? 1 : 2);
  settings.seed = static_cast<std::uint64_t>(table.integer_or("seed", 1, Bound::non_negative));
  return settings;
}

std::string to_toml(const MonteCarloSettings& settings) {
  return fmt::format("{{ method = \"monte_carlo\", draws = {}, digits = {}, seed = {} }}",
                     settings.draws ? fmt::format("{}", *settings.draws) : "\"adaptive\"",
                     settings.digits, settings.seed);
}

}  // namespace frustum::metrology

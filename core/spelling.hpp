// The known word nearest to a misspelt one, for diagnostics.
//
// Units: none. Errors: none; a word that resembles nothing yields no suggestion.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustum {

// The candidate with the least edit distance (case ignored), when it is near enough to be meant.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word,
                                                      std::span<const std::string> candidates);

// "did you mean X?" or, with no near candidate, "known: a, b, c"; empty without candidates.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string> candidates);

}  // namespace frustum

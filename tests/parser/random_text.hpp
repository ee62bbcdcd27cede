// Random programs as text that is read without a mistake, in every statement of their language.
// Whether they could be run does not matter.
//
// Randomness is keyed by the seed alone, so that a failure names the program that caused it.
#pragma once

#include <cstdint>
#include <string>

#include "parser/dialect.hpp"

namespace frustum::parser {

[[nodiscard]] std::string random_text(std::uint64_t seed, Dialect dialect);

}  // namespace frustum::parser

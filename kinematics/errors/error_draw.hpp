// One draw of the errors that are written as distributions.
//
// Model    : every amount has a stream of its own, keyed by its place (error, term, amount) or, for
//            a drawn quantity, by its name; so a draw depends on neither order nor company of the
//            entries. A normal amount beyond its limit is drawn again
// Units    : mm, rad
// Errors   : none; distributions are checked where they are read
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinematics/errors/error_shape.hpp"

namespace frustum::kinematics {

// The entries with every amount fixed; `written` tells what was drawn.
[[nodiscard]] std::vector<ErrorEntry> draw(std::span<const ErrorEntry> entries, std::uint64_t seed,
                                           std::uint32_t index = 0);

}  // namespace frustum::kinematics

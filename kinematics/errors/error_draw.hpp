// One draw of the errors that are written as distributions.
//
// Model    : every amount has a stream of its own, keyed by its place (error, term, amount) or, for
//            a drawn quantity, by its name; so a draw depends on neither order nor company of the
//            entries. A normal amount beyond its limit is drawn again; a tolerance without a
//            reading is uniform
// Units    : mm, rad
// Errors   : none; distributions are checked where they are read
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "kinematics/errors/error_shape.hpp"

namespace frustum::kinematics {

// The entries with every amount fixed; `written` tells what was drawn.
[[nodiscard]] std::vector<ErrorEntry> draw(std::span<const ErrorEntry> entries, std::uint64_t seed,
                                           std::uint32_t index = 0);

// The number of the stream that a place ("EXX/0/amount/0") or a name ("drawn a1") has: FNV-1a of 64
// bits, the same on every platform.
[[nodiscard]] std::uint64_t stream_of(std::string_view name);
// One value of a distribution.
[[nodiscard]] double drawn_from(const Distribution& distribution, const RandomKey& key,
                                std::uint64_t stream);

}  // namespace frustum::kinematics

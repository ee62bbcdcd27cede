// Canned cycles in a program: their words, which stay in force until the motion changes, and their
// repeats.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// Where the tool is at a depth of the hole, on its axis or shifted.
using PlaceInHole = std::function<Vec3(double depth, bool shifted)>;

[[nodiscard]] Outcome run_cycle(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);
void drill(InterpreterState& state, const std::vector<CycleStep>& steps, std::uint32_t column,
           const PlaceInHole& place, const Feed& feed, const Feed& feed_out);

}  // namespace frustum::parser

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

// A tap whose axis follows the angle of the spindle, which turns back where it is deepest: G84
// after M29, CYCL DEF 17, 207 and 209, CYCLE84, CYCLE840 with an encoder.
struct RigidTap {
  double lead = 0.0;      // mm; below zero: left-handed
  double speed = 0.0;     // 1/min into the hole; the steps name another one of the way back
  SpindleChange after{};  // how the spindle turns when the hole is done
};

[[nodiscard]] Outcome run_cycle(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);
void drill(InterpreterState& state, const std::vector<CycleStep>& steps, std::uint32_t column,
           const PlaceInHole& place, const Feed& feed, const Feed& feed_out);
// The tool is where feeding begins.
void tap_hole(InterpreterState& state, const std::vector<CycleStep>& steps, std::uint32_t column,
              const PlaceInHole& place, const RigidTap& tap);

}  // namespace frustum::parser

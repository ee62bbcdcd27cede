// Moves to reference points (G28, G30) and in machine coordinates (G53), and the points that a
// program stores.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// G28 and G30: by the place that the words name, then the axes named to the reference point. One
// that the program knows is a place like any other; else it is the machine's.
[[nodiscard]] Outcome go_home(InterpreterState& state, const BlockWords& words, std::size_t point);
// G27: by rapid to where the words say, which the control holds against the reference point.
// G74, G75: straight to it, whatever the values of the words.
[[nodiscard]] Outcome approach_point(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome check_home(InterpreterState& state, const BlockWords& words);
// G29: the axes named go by rapid to the place that G28 or G30 went by, then to the end. Steps
//      count from that place.
[[nodiscard]] Outcome come_from_home(InterpreterState& state, const BlockWords& words);
// G28.1, G30.1: the reference point is where the axes are. An axis that has never moved keeps the
// machine's.
[[nodiscard]] Outcome keep_point(InterpreterState& state, std::size_t point, std::uint32_t column);
[[nodiscard]] Outcome move_in_machine_coordinates(InterpreterState& state, const BlockWords& words,
                                                  const Movement& movement);

// Steps of axes whose place only the machine knows, since G53 or G28 sent them there.
[[nodiscard]] bool steps_by_axes(const InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome step_axes(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);
// M140: away from the workpiece along the tool, by z or to the end of the travel.
[[nodiscard]] Outcome retract_tool(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser

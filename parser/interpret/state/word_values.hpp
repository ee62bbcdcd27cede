// The values of words as lengths in mm, angles in rad, whole numbers and vectors, by the modes in
// force.
//
// Units : mm, rad; a feed scale is mm per unit of the F word
// Errors: a number that has to be whole and is not, or is out of range
#pragma once

#include <string_view>

#include "core/result.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Every length passes here: in mm, and noted where nothing has given the unit.
[[nodiscard]] double length_of(const InterpreterState& state, double value);
[[nodiscard]] Vec3 lengths_of(const InterpreterState& state, const BlockWords& words,
                              std::string_view letters);
// mm of a length that the program writes as 1, in dialects whose unit is never open.
[[nodiscard]] double unit_scale(const InterpreterState& state);
[[nodiscard]] double scaled(const InterpreterState& state, AxisLetter axis, double value);
// Of an F word: lengths in mm that it counts in.
[[nodiscard]] double feed_scale(const InterpreterState& state, FeedMode mode);
[[nodiscard]] Result<int> whole(const InterpreterState& state, const BlockWords& words, char letter,
                                int least, int most);
[[nodiscard]] Vec3 vector_of(const BlockWords& words, std::string_view letters);
// The value of one of the block's expressions.
[[nodiscard]] Result<double> value_of(InterpreterState& state, const Block& block,
                                      ExpressionRange range);

}  // namespace frustum::parser

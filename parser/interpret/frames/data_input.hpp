// G10: what a program writes into the control's data, by its L word; tools that it defines.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// What the control keeps of the tool length that is in force; absent where nothing says it.
struct LengthInForce {
  std::optional<double> length{};
  double wear = 0.0;
  bool operator==(const LengthInForce&) const = default;
};
[[nodiscard]] LengthInForce length_in_force(const InterpreterState& state);
// The program has set the data: a length in force that has changed counts later.
void assume_length_waits(InterpreterState& state, std::uint32_t column,
                         const LengthInForce& before);

// Offsets of radii that the program writes, by G10 or parameters.
void assume_radius(InterpreterState& state, std::uint32_t column);
// mm, of a tool's own data; that it differs from what the setup has is reported by the word's name.
void set_tool_radius(InterpreterState& state, std::uint32_t column, std::string_view word,
                     int number, double radius);
[[nodiscard]] Outcome set_data(InterpreterState& state, const BlockWords& words);
// TOOL DEF: e its number, L its length, R its radius.
[[nodiscard]] Outcome define_tool(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser

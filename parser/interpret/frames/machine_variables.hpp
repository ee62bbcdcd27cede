// System variables of Sinumerik that a program sets: $TC_DP6[1,1]=5, $P_UIFR[1,X,TR]=10.
//
// Radii of tools and shifts of work offsets are carried out. Names of tools are kept. Lengths of
// tools and frames that are not simulated are refused; others change nothing that is simulated, and
// are events.
// Units : as written
// Errors: a variable that would move the tool and is not simulated, a value that is unknown
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_machine_variable(InterpreterState& state, std::uint32_t column,
                                           const std::string& name, double value);

// CTRANS(X,10,Y,20)
struct MachineFrame {
  std::string name{};
  std::string axes{};
  std::vector<double> values{};
};
// $P_UIFR[1]=CTRANS(X,10):CROT(Z,30), $P_PFRAME=..
[[nodiscard]] Outcome set_machine_frame(InterpreterState& state, std::uint32_t column,
                                        const std::string& name,
                                        const std::vector<MachineFrame>& parts);

}  // namespace frustum::parser

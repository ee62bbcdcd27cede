// CYCLE81 to CYCLE89 of Sinumerik and MCALL: the parameters of drilling cycles as words of a block.
//
// The letters of the words are those of drilling_cycle.hpp.
// Units : none
// Errors: a bracket that is missing, parameters too many, MCALL of something else; at the draft's
//         scanner
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

struct CycleParameter {
  char letter;
  const char* spelled;  // "RTP="
};
// In the order of the call; empty for what is none of the cycles.
[[nodiscard]] std::span<const CycleParameter> sinumerik_cycle_parameters(std::string_view name);

[[nodiscard]] bool is_sinumerik_cycle(std::string_view name);
// What is after the name.
void read_sinumerik_cycle(BlockDraft& draft, const std::string& name, std::uint32_t column);
// What is after MCALL: a cycle, or nothing.
void read_sinumerik_modal_call(BlockDraft& draft, std::uint32_t column);

}  // namespace frustum::parser

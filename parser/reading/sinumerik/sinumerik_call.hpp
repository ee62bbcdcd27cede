// Subprograms of Sinumerik: their heads %_N_NAME_SPF and PROC, their calls, and their variables.
//
// Units : none
// Errors: a type or name that is missing, types that are not simulated, words beside a call; at the
//         draft's scanner
#pragma once

#include <string>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

// What is after the % of a line.
void read_sinumerik_head(BlockDraft& draft);
// PROC NAME(REAL WIDTH, INT COUNT=2) SAVE
void read_sinumerik_procedure(BlockDraft& draft, std::uint32_t column);
// DEF REAL WIDTH=5, DEPTH
void read_sinumerik_definition(BlockDraft& draft, std::uint32_t column);
// NAME(1, R2) P3; the name is read.
void read_sinumerik_call(BlockDraft& draft, const std::string& name, std::uint32_t column);

// CALL "NAME", EXTCALL("NAME"), PCALL NAME(1,2): after the first word.
void read_sinumerik_named_call(BlockDraft& draft, std::uint32_t column);

}  // namespace frustum::parser

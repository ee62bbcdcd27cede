// What a block of Sinumerik sets or tells without moving: SPOS=30, MSG("..."), H5, M2=3,
// $TC_DP6[1,1]=5, FIELD[2]=SET(1,2).
//
// Units : none
// Errors: a bracket, = or value that is missing; at the draft's scanner
#pragma once

#include <string>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

// The setting or event of that name; false when there is none.
[[nodiscard]] bool read_sinumerik_setting(BlockDraft& draft, const std::string& name,
                                          std::uint32_t column);
// U0, V=0, W0: the letter is read; false when it is none of these.
[[nodiscard]] bool read_parallel_axis(BlockDraft& draft, char letter, std::uint32_t column);
// WIDTH=5, FIELD[1]=5; the name is read.
void read_variable_setting(BlockDraft& draft, const std::string& name, std::uint32_t column);
// Of a setting or definition, after its =: one value, or SET(1,2,3), REP(0), (1,2,3).
void read_setting_values(BlockDraft& draft);
// $TC_DP6[1,1]=5
void read_system_setting(BlockDraft& draft, std::uint32_t column);
// H5, H1=5, M2=3: of the builder, after its letter. `name` is kept, with the number as its text.
void read_auxiliary(BlockDraft& draft, const char* name, std::uint32_t column);
// M202(0.5): of the builder.
void read_builder_call(BlockDraft& draft, const std::string& name, std::uint32_t column);
// TRAORI(1), TRAFOOF(), SETMS(1)
void read_brackets_of_word(BlockDraft& draft, const std::string& name, std::uint32_t column);

}  // namespace frustum::parser

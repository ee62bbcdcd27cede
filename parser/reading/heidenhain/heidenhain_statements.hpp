// The statements of Klartext by their first word, each in a file with its like; and what they
// share.
//
// `column` is that of the first word, which is read already.
// Units : none; values are as written
// Errors: those of each statement; at the draft's scanner
#pragma once

#include <string>
#include <string_view>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

// L, LN, C, CR, CT, LP, CP, CTP; the elements of a line that has no path: STOP M5; axes alone; CC.
void read_heidenhain_path(BlockDraft& draft, const std::string& statement, std::uint32_t column);
// APPR LT, DEP LCT: on to a contour and off it.
void read_heidenhain_link(BlockDraft& draft, const std::string& statement, std::uint32_t column);
void read_heidenhain_elements(BlockDraft& draft, const std::string& statement);
void read_heidenhain_axes(BlockDraft& draft, const std::string& statement);
void read_heidenhain_call_at(BlockDraft& draft, const std::string& statement, std::uint32_t column);
void read_heidenhain_pole(BlockDraft& draft, std::uint32_t column);
// RND R5 F100, CHF 2
void read_heidenhain_corner(BlockDraft& draft, const std::string& statement, std::uint32_t column);
// Q1 = ..., FN 0: .., LBL, CALL LBL.
void read_heidenhain_setting(BlockDraft& draft, const std::string& name, std::uint32_t column);
void read_heidenhain_fn(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_label(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_call(BlockDraft& draft, std::uint32_t column);

void read_heidenhain_tool(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_plane(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_function(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_cycle(BlockDraft& draft, std::uint32_t column);
// PATTERN DEF POS1 (X+10 Y+20 Z+0)
void read_heidenhain_pattern(BlockDraft& draft, std::uint32_t column);
void read_heidenhain_probing(BlockDraft& draft, std::uint32_t column);
// TRANS DATUM AXIS X+5, PRESET SELECT #1
void read_heidenhain_transform(BlockDraft& draft, const std::string& statement,
                               std::uint32_t column);

// A call of the program file that is named next: TNC:\\WORK\\SLOT.H, "SLOT.H", SLOT. Folders of the
// control are left out.
void read_heidenhain_program_call(BlockDraft& draft, bool by_cycle);

[[nodiscard]] const ExpressionRules& heidenhain_expressions();
// Q1, QL1, QR1
[[nodiscard]] bool is_q_parameter(std::string_view name);
// QS1
[[nodiscard]] bool is_text_parameter(std::string_view name);
// A word with [ + | - ] and a number or a parameter.
void add_value(BlockDraft& draft, char letter, std::string_view whose, std::uint32_t column,
               const char* spelled);
// A statement that is known and not simulated.
void note(BlockDraft& draft, const char* event, std::uint32_t column, std::string text);
// Comments may follow, nothing else.
void end_statement(BlockDraft& draft);
void add_dwell(BlockDraft& draft, double seconds, std::uint32_t column);

}  // namespace frustum::parser

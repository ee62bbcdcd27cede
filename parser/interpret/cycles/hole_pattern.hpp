// HOLES1, HOLES2 and CYCLE801 of Sinumerik: the places of a row, a circle or a grid of holes.
//
// Model : HOLES1 (SPCA,SPCO,STA1,FDIS,DBH,NUM): NUM places DBH apart on a line by STA1 from the
//         reference point, the first FDIS from it; from the end that is nearer to the tool.
//         HOLES2 (CPA,CPO,RAD,STA1,INDA,NUM): on a circle, from STA1 on by INDA, or evenly.
//         CYCLE801 (_SPCA,_SPCO,_STA,_DIS1,_DIS2,_NUM1,_NUM2): rows of _NUM1 places _DIS1 apart,
//         _NUM2 of them _DIS2 apart, turned by _STA; to and fro along the axis with the smaller
//         spacing, from the corner that is nearest to the tool
// Units : mm
// Errors: a number of holes that is none, a distance below zero
// Source: Siemens, SINUMERIK 840D/840Di/810D Programming Guide Cycles (PGZ), drilling patterns; the
//         order of a grid as the control's own CYCLE801 (V06.02.09) has it
#pragma once

#include <vector>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Result<std::vector<Vec2>> pattern_places(InterpreterState& state,
                                                       const BlockWords& words);

}  // namespace frustum::parser

// Drilling cycles whose heights are coordinates along the normal of the plane: CYCLE81 to CYCLE89
// of Sinumerik, at the place where the tool is.
//
// The letters of the words: z RTP, V RFP, u SDIS, Z DP, d DPR, P DTB; x the axis, g h i the modes
// of the call.
//   CYCLE83 K FDEP, Q FDPR, r DAM, W DTS, f FRF, e VARI, m the least stroke, v the retract that
//   breaks the chip,
//           t the dwell at the bottom, w the distance kept on the way back
//   CYCLE84 e SDAC, m MPIT, k PIT, E POSS, s SST, l SST1, f _PTAB, r _TECHNO, t _VARI, Q _DAM,
//           v _VRT                                           CYCLE85 f FFR, r RFF
//   CYCLE86 e SDIR, I J K the retract, E POSS                CYCLE87, CYCLE88 e SDIR
//
// Units : mm, mm/min, seconds
// Shape : pecks() below RFP, rising, the last one the whole depth
// Errors: none; the words are checked by the caller
// Source: SINUMERIK 840D, programming guide of the cycles, drilling cycles; the last two strokes,
//         the way back to a depth and taps in several strokes as the control's own CYCLE83 and
//         CYCLE84 (V06.02.09) do them
#pragma once

#include <optional>
#include <vector>

#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/state/drilling_cycle.hpp"

namespace frustum::parser {

[[nodiscard]] std::vector<double> pecks(const DrillingCycle& cycle);
// From `level` on; empty when there would be more than kMostPecks.
[[nodiscard]] std::vector<CycleStep> steps_of(const DrillingCycle& cycle);
// Of a metric thread M3 to M48; none for others.
[[nodiscard]] std::optional<double> metric_lead(double size);

}  // namespace frustum::parser

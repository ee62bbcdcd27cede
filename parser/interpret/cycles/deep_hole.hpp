// Deep holes of Klartext: what the tool does at one hole of CYCL DEF 203 and 205, whose pecks
// shrink from one to the next.
//
// Model : peck n goes (first - n decrement), but no less than `least`, deeper than the one before;
//         the last one to the depth. After a peck the tool breaks the chip (goes back by `chip`),
//         or clears the hole (goes up to `level`, waits, comes back by rapid to a stop above the
//         last depth).
// Units : mm along the axis of the hole, upwards from its top; seconds
// Shape : the tool is above the hole at `level`
// Errors: none; the caller checks that peck_count() is no more than kMostPecks
// Source: Heidenhain cycle programming manual, cycles 203 (universal drilling) and 205 (universal
//         pecking)
#pragma once

#include <vector>

#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/state/hole_cycle.hpp"

namespace frustum::parser {

// Infinite where the pecks shrink to nothing.
[[nodiscard]] double peck_count(const DeepHole& hole);
[[nodiscard]] std::vector<CycleStep> steps_at_deep_hole(const DeepHole& hole, double level,
                                                        double clear);

}  // namespace frustum::parser

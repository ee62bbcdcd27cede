// Deep holes of Klartext: what the tool does at one hole of CYCL DEF 203 and 205, whose pecks shrink from one to the next.
//
// Model : peck n goes (first - n decrement), but no less than `least`, deeper than the one before; the last one to the
//         depth. After a peck the tool breaks the chip (goes back by `chip`), or clears the hole (goes up to `level`,
//         waits, comes back by rapid to a stop above the last depth).
// Units : mm along the axis of the hole, upwards from its top; seconds
// Shape : the tool is above the hole at `level`
// Errors: none; the caller checks that peck_count() is no more than kMostPecks
// Source: Heidenhain cycle programming manual, cycles 203 (universal drilling) and 205 (universal pecking)
#pragma once

#include <vector>

#include "parser/interpret/cycles/canned_cycle.hpp"

namespace frustum::parser {

struct DeepHole {
  double depth = 0.0;       // below the top
  double first = 0.0;       // Q202; 0: one peck
  double decrement = 0.0;   // Q212
  double least = 0.0;       // Q205
  int breaks = 0;           // Q213 of 203: so many pecks break the chip before one clears the hole
  double break_each = 0.0;  // Q257 of 205: so deep the chip is broken, within a peck
  double chip = 0.2;        // Q256
  // Q258, Q259 of 205: the stop above the last depth before the second peck and before the last one, even between them.
  double first_stop = 0.0;
  double last_stop = 0.0;
  double dwell_above = 0.0;
  double dwell = 0.0;
  bool clears_by_feed = false;  // 203: up to `level` by the feed out, not by rapid
  bool leaves_by_feed = false;  // the same after the last peck
};

// Infinite where the pecks shrink to nothing.
[[nodiscard]] double peck_count(const DeepHole& hole);
[[nodiscard]] std::vector<CycleStep> steps_at_deep_hole(const DeepHole& hole, double level,
                                                        double clear);

}  // namespace frustum::parser

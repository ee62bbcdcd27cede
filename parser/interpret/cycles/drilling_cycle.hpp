// Drilling cycles whose heights are coordinates along the normal of the plane: CYCLE81 to CYCLE89
// of Sinumerik, at the place where the tool is.
//
// The letters of the words: z RTP, V RFP, u SDIS, Z DP, d DPR, P DTB; x the axis, g h i the modes
//   of the call. CYCLE83 K FDEP, Q FDPR, r DAM, W DTS, f FRF, e VARI, m the least stroke, v the
//   retract that breaks the chip,
//           t the dwell at the bottom, w the distance kept on the way back
//   CYCLE84 e SDAC, m MPIT, k PIT, E POSS, s SST, l SST1     CYCLE85 f FFR, r RFF
//   CYCLE86 e SDIR, I J K the retract, E POSS                CYCLE87, CYCLE88 e SDIR
//
// Units : mm, mm/min, seconds
// Shape : pecks() below RFP, rising, the last one the whole depth
// Errors: none; the words are checked by the caller
// Source: SINUMERIK 840D, programming guide of the cycles, drilling cycles
#pragma once

#include <optional>
#include <vector>

#include "parser/dialects/code.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct DrillingCycle {
  DrillingWord kind = DrillingWord::drill;
  double reference = 0.0;  // RFP
  double level = 0.0;      // RFP + SDIS: where feeding begins
  double bottom = 0.0;
  double back = 0.0;   // RTP: where the tool goes afterwards
  double dwell = 0.0;  // at the bottom
  // Pecks.
  bool clears = false;           // VARI 1: up to `level` after each
  double first = 0.0;            // the first stroke
  double degression = 0.0;       // above zero: an amount; below: a factor
  double least = 0.0;            // stroke of a factor
  double dwell_below = 0.0;      // after each stroke
  double dwell_above = 0.0;      // at `level`
  double first_feed = 1.0;       // its share of the feed
  double chip = 1.0;             // the retract that breaks it
  std::optional<double> near{};  // how far above the last depth the tool comes back by rapid
  // Feeds of their own, mm/min.
  std::optional<double> feed{};
  std::optional<double> feed_out{};
  double lead = 0.0;   // of a thread
  double speed = 0.0;  // of the spindle, 1/min; while it goes back
  double speed_back = 0.0;
  Vec3 retract = Vec3::Zero();                  // along the plane's first, second and third axis
  std::optional<SpindleDirection> direction{};  // before the hole, of a tap after it
};

[[nodiscard]] std::vector<double> pecks(const DrillingCycle& cycle);
// From `level` on; empty when there would be more than kMostPecks.
[[nodiscard]] std::vector<CycleStep> steps_of(const DrillingCycle& cycle);
// Of a metric thread M3 to M48; none for others.
[[nodiscard]] std::optional<double> metric_lead(double size);

}  // namespace frustum::parser

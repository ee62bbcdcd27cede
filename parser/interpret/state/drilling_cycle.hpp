// The drilling cycle in force or called, with its heights as coordinates along the normal of the
// plane: CYCLE81 to CYCLE89 of Sinumerik. What it does at a hole is in cycles/drilling_steps.hpp.
//
// Units : mm, mm/min, seconds
// Errors: none
#pragma once

#include <optional>

#include "core/diagnostic.hpp"
#include "parser/dialects/code.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct DrillingCycle {
  DrillingWord kind = DrillingWord::drill;
  // What is wrong with a call by MCALL: only a hole finds it.
  std::optional<Diagnostic> fault{};
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
  double lead = 0.0;        // of a thread; below zero: left-handed
  bool by_spindle = false;  // a tap whose axis follows the spindle
  double speed = 0.0;       // of the spindle, 1/min; while it goes back
  double speed_back = 0.0;
  Vec3 retract = Vec3::Zero();                  // along the plane's first, second and third axis
  std::optional<SpindleDirection> direction{};  // before the hole, of a tap after it
  std::optional<SpindleDirection> direction_back{};  // of CYCLE840; absent: reversed
};

}  // namespace frustum::parser

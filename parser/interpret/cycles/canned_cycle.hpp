// Canned cycles: what the tool does at one hole, G73 to G89.
//
// Depths are coordinates along the axis of the plane's normal: Z in G17, Y in G18, X in G19.
//
//   G76  bores, stops and shifts the tool, leaves by rapid
//   G73  pecks that break the chip     G85  bores, feeds out
//   G74  taps left-handed              G86  bores, stops the spindle, leaves by rapid
//   G81  drills                        G87  bores from behind, with the tool shifted
//   G82  drills, dwells                G88  bores, stops for the operator, who retracts
//   G83  pecks that clear the hole     G89  bores, dwells, feeds out
//   G84  taps
//
// Units : mm, seconds
// Shape : the steps of one hole, in order
// Errors: none; the words are checked by the caller
// Source: ISO 6983-1 table of canned cycles; the chip-breaking retract and the clearance of a peck
//         are those of LinuxCNC, 0.010 in
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/units.hpp"
#include "parser/language/modes.hpp"

namespace frustum::parser {

// The retract that breaks a chip, and the clearance above the last peck.
constexpr double kChip = 0.010 * kMmPerInch;

struct CycleDepths {
  double level = 0.0;     // R: where feeding begins
  double bottom = 0.0;    // Z
  double clear = 0.0;     // where the tool goes afterwards: R (G99) or where it was before (G98)
  double feed_out = 0.0;  // up to where taps and G89 leave by feed: R, of LinuxCNC `clear`
  double peck = 0.0;      // Q
  double chip = kChip;    // how far above the last peck the tool stops coming back
  std::optional<double> peck_from{};  // where pecks are counted from; R
  double dwell_above = 0.0;           // after each peck that clears the hole, seconds
  double dwell = 0.0;                 // P, seconds
  double back = 0.0;                  // K of G87: how far the bore goes up to
  bool from_level = false;            // G87 by Q: the bore goes from `level` up to `bottom`
  bool out_by_hand = false;           // G88: after the stop the tool is at `level`
  bool rigid = false;  // taps: as RigidTap, which begins and ends the spindle's turns
};

enum class CycleAction : std::uint8_t {
  rapid,
  feed,
  dwell,
  stop_spindle,
  start_spindle,    // as it turned before, perhaps with another speed
  reverse_spindle,  // against that
  orient_spindle,
  wait  // for the operator
};
struct CycleStep {
  CycleAction action = CycleAction::rapid;
  double value = 0.0;    // depth of a move, seconds of a dwell, another speed of a reversed spindle
  bool shifted = false;  // a move to the hole's place shifted by I J, or back from it
  double share = 1.0;    // of the feed
};

// More pecks than this are taken for a mistake.
constexpr double kMostPecks = 10'000.0;

// The tool is above the hole at `level`.
[[nodiscard]] std::vector<CycleStep> steps_at_hole(MotionMode cycle, const CycleDepths& depths);

}  // namespace frustum::parser

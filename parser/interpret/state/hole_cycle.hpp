// Hole cycles: defined once, done at each hole that the program names afterwards. CYCLE of CLDATA;
// CYCL DEF 200 to 207, 209, 240, 241, 1, 2 and 17 of Klartext, called by CYCL CALL or M99 where the
// tool is, by M89 where each move ends, by CYCL DEF 220 and 221 on a ring or a grid, by CYCL CALL
// PAT at the points of PATTERN DEF.
//
// The words of a definition: Z depth, R where feeding begins, u how high the tool comes by rapid, v
// how high it goes afterwards (I: as high as before the first hole), Q the peck, P the dwell in
// seconds, f or r the feed, t the lead of a tap. Of Klartext: z the depth, below zero; V the height
// of the top; Q counts from the top; w the dwell above; W the feed out. Of 203 and 205: D how much
// a peck is less than the one before, L the least peck, H how far a chip is broken, K how often
// before the hole is cleared, E how deep each time, g and h the stops above the last depth; of
// DEEP2: x each peck after the first. Of 202: n the direction off the wall, o how far. Of 220 and
// 221: x y the centre or the corner, d the diameter, a b c the start, stop and step of the angle,
// or the spacings and the turn; K L how many holes, e and l how the tool goes between them.
// Units : mm along the axis of the hole, from its top; seconds
// Errors: none
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "parser/language/block.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// The largest feed that a cycle takes; feeding out by it is going by rapid.
constexpr double kFastestFeed = 99'999.0;

// Pecks that shrink from one to the next: what follows from them is in cycles/deep_hole.hpp.
struct DeepHole {
  double depth = 0.0;              // below the top
  double first = 0.0;              // Q202; 0: one peck
  double decrement = 0.0;          // Q212
  double least = 0.0;              // Q205
  std::optional<double> others{};  // each peck after the first; then no decrement
  int breaks = 0;           // Q213 of 203: so many pecks break the chip before one clears the hole
  double break_each = 0.0;  // Q257 of 205: so deep the chip is broken, within a peck
  double chip = 0.2;        // Q256
  // Q258, Q259 of 205: the stop above the last depth before the second peck and before the last
  // one, even between them.
  double first_stop = 0.0;
  double last_stop = 0.0;
  double dwell_above = 0.0;
  double dwell = 0.0;
  bool clears_by_feed = false;  // 203: up to `level` by the feed out, not by rapid
  bool leaves_by_feed = false;  // the same after the last peck
};

struct HoleCycle {
  MotionMode kind = MotionMode::none;  // a canned cycle's; none: nothing is defined
  bool on = false;
  double depth = 0.0;            // below the top
  double level = 0.0;            // where feeding begins
  double clear = 0.0;            // where the tool comes to by rapid
  std::optional<double> back{};  // where it goes afterwards; absent: `clear`
  bool back_to_start = false;    // as high as before the first hole
  double peck = 0.0;
  double dwell = 0.0;
  Feed feed{};
  std::optional<Feed> feed_out{};
  // Its coordinate along Z; absent: the hole's place says, or the tool is `clear` above it.
  std::optional<double> top{};
  double dwell_above = 0.0;      // seconds
  bool at_moves = false;         // M89
  bool of_tool = false;          // 1, 2: heights count from where the tool is
  std::optional<double> lead{};  // of a rigid tap; below zero: left-handed; its feed is of no use
  bool hand_of_spindle = false;  // the hand of the lead: CYCLE/TAP of CLDATA
  double tap_step = 0.0;         // 209: so deep the chip is broken; 0: not at all
  double tap_back = 0.0;         // how far it goes back then; 0: out of the hole
  Vec3 off_wall = Vec3::Zero();  // of 202, before the tool goes back
  std::optional<Vec3> start{};   // where the tool was then
  std::optional<DeepHole> deep{};
  std::shared_ptr<const Block> definition{};  // of Klartext, from 200 on: cycle_parameters.hpp
  std::string program{};                      // a call runs this program file instead (CYCL DEF 12)
};

}  // namespace frustum::parser

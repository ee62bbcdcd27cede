// What a cutting move needs: a turning spindle, a tool with its length, a feed that can be meant.
//
// Units : mm, mm/min, 1/min
// Errors: none
#pragma once

#include "lint/cutting_move.hpp"
#include "lint/finding_list.hpp"
#include "parser/dialect.hpp"

namespace frustum::lint {

// Feeds beyond these are reported. Roughing of aluminium goes to 20 m/min, cuts of superalloys down
// to 10 mm/min.
constexpr double kHighFeed = 40'000.0;    // mm/min
constexpr double kLowFeed = 3.0;          // mm/min
constexpr double kHighFeedPerTurn = 5.0;  // mm
constexpr double kShortSegment = 0.005;   // mm

// "tool 7", "edge 2 of tool 7": whose the length of that offset number is.
[[nodiscard]] std::string offset_name(int number, parser::Dialect dialect);

void check_spindle(const CuttingMove& move, const MotionState& state, FindingList& findings);
void check_tool(const CuttingMove& move, const MotionState& state, parser::Dialect dialect,
                FindingList& findings);
void check_length_number(const parser::Motion& motion, const MotionState& state,
                         parser::Dialect dialect, FindingList& findings);
void check_feed(const CuttingMove& move, FindingList& findings);

// Counts the moves that are too short to be meant.
class ShortSegments {
 public:
  void see(const CuttingMove& move);
  void finish(FindingList& findings) const;

 private:
  std::uint64_t count_ = 0;
  double shortest_ = kShortSegment;
  parser::SourcePlace first_{};
  LineSet lines_{};
};

}  // namespace frustum::lint

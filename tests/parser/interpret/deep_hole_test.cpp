// CYCL DEF 203 and 205 of Klartext: pecks that shrink, broken chips, cleared holes, with heights
// derived by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "parser/interpret/cycles/deep_hole.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

// "f-4 r2 d0.5": feeds, rapid moves and dwells with their heights and seconds, after the move over
// the hole.
std::string heights(const std::string& cycle) {
  std::string found;
  const auto all = motions(
      "TOOL CALL 1 Z S1000\nM3\nL X+0 Y+0 Z+50 R0 FMAX\n" + cycle + "\nL X+10 Y+5 FMAX M99\n", {},
      Dialect::heidenhain);
  for (const Motion& motion : all) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      found += fmt::format("r{:.6g} ", *rapid->end[Z]);
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      found += fmt::format("f{:.6g}/{:g} ", *feed->end[Z], feed->feed.value);
    } else if (const auto* dwell = std::get_if<Dwell>(&motion.command)) {
      found += fmt::format("d{:g} ", dwell->seconds);
    }
  }
  return found.substr(found.find("r2 ") + 3);
}

TEST(DeepHole, ClearsTheHoleByTheFeedOutInUniversalDrilling) {
  EXPECT_EQ(heights("CYCL DEF 203 Q200=2 Q201=-10 Q206=100 Q202=4 Q203=0 Q204=20 Q208=900 Q210=0.3 "
                    "Q211=0.5"),
            "f-4/100 f2/900 d0.3 r-2 f-8/100 f2/900 d0.3 r-6 f-10/100 d0.5 f2/900 r20 ");
  // Without a feed of its own it comes out as it went in.
  EXPECT_EQ(heights("CYCL DEF 203 Q200=2 Q201=-3 Q206=100 Q202=4 Q203=0 Q208=0"),
            "f-3/100 f2/100 ");
}

TEST(DeepHole, BreaksTheChipSoOftenBeforeItClearsTheHole) {
  EXPECT_EQ(heights("CYCL DEF 203 Q200=2 Q201=-10 Q206=100 Q202=2 Q203=0 Q213=2 Q256=0.5"),
            "f-2/100 r-1.5 f-4/100 r-3.5 f-6/100 f2/100 r-4 f-8/100 r-7.5 f-10/100 f2/100 ");
}

TEST(DeepHole, PecksShrinkDownToTheLeast) {
  EXPECT_EQ(heights("CYCL DEF 203 Q200=2 Q201=-10 Q206=100 Q202=4 Q203=0 Q212=1.5 Q205=2 Q213=9"),
            "f-4/100 r-3.8 f-6.5/100 r-6.3 f-8.5/100 r-8.3 f-10/100 f2/100 ");
  // A least peck above the first one does not enlarge it.
  EXPECT_EQ(heights("CYCL DEF 203 Q200=2 Q201=-5 Q206=100 Q202=2 Q203=0 Q212=1 Q205=3 Q213=9"),
            "f-2/100 r-1.8 f-4/100 r-3.8 f-5/100 f2/100 ");
}

TEST(DeepHole, StopsAboveTheLastDepthInUniversalPecking) {
  // The stop goes evenly from 0.5 before the second peck to 1.5 before the last one.
  EXPECT_EQ(heights("CYCL DEF 205 Q200=2 Q201=-20 Q206=100 Q202=5 Q203=0 Q204=20 Q258=0.5 "
                    "Q259=1.5 Q211=0.25 Q379=0 Q253=750"),
            "f-5/100 r2 r-4.5 f-10/100 r2 r-9 f-15/100 r2 r-13.5 f-20/100 d0.25 r2 r20 ");
  EXPECT_EQ(heights("CYCL DEF 205 Q200=2 Q201=-8 Q206=100 Q202=5 Q203=0 Q208=500"),
            "f-5/100 r2 r-4.8 f-8/100 f2/500 ");
}

TEST(DeepHole, BreaksTheChipWithinAPeckOfUniversalPecking) {
  EXPECT_EQ(heights("CYCL DEF 205 Q200=2 Q201=-10 Q206=100 Q202=6 Q203=0 Q257=2.5 Q256=1"),
            "f-2.5/100 r-1.5 f-5/100 r-4 f-6/100 r2 r-5.8 f-8.5/100 r-7.5 f-10/100 r2 ");
}

TEST(DeepHoleLaws, FeedsAddUpToTheDepthAndReachEachPlaceOnce) {
  for (int i = 1; i <= 200; ++i) {
    DeepHole hole;
    hole.depth = 1.0 + 0.37 * i;
    hole.first = 0.5 + 0.11 * (i % 17);
    hole.decrement = 0.05 * (i % 5);
    hole.least = 0.2;
    hole.breaks = i % 4;
    hole.break_each = i % 3 == 0 ? 0.4 : 0.0;
    hole.first_stop = hole.last_stop = 0.3;
    double deepest = 0.0;
    int pecks = 0;
    for (const CycleStep& step : steps_at_deep_hole(hole, 2.0, 5.0)) {
      if (step.action == CycleAction::dwell) continue;
      if (step.action == CycleAction::feed) {
        EXPECT_LT(step.value, deepest) << i;
        deepest = step.value;
        ++pecks;
      } else {
        // Rapid moves stay where the hole is cut already.
        EXPECT_GT(step.value, deepest) << i;
      }
    }
    EXPECT_DOUBLE_EQ(deepest, -hole.depth);
    EXPECT_LE(pecks, peck_count(hole) + 1.0) << i;
  }
}

struct WrongHole {
  const char* words;
  const char* complaint;
};

TEST(DeepHoleErrors, SayWhereWhatAndTheRemedy) {
  const WrongHole mistakes[] = {
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0", "1:1: error: CYCL DEF 203 has no Q202"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q258=1",
       "1:50: error: Q258 has no meaning in CYCL DEF 203"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=-1", "1:43: error: Q202=-1 is negative"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q213=0.5",
       "1:50: error: Q213=0.5 is not a whole number"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=2 Q212=1",
       "1:50: error: the pecks shrink to nothing above the bottom"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=0.0001",
       "1:43: error: the cycle makes more than 10000 pecks"},
      {"203 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q395=1", "1:50: error: Q395 is not simulated"},
      {"205 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q379=5", "1:50: error: Q379 is not simulated"},
      {"205 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q257=0.0001",
       "1:50: error: the cycle makes more than 10000 pecks"},
      {"205 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q258=-1", "1:50: error: Q258=-1 is negative"},
      {"205 Q200=2 Q201=-9 Q206=9 Q203=0 Q202=1 Q213=1",
       "1:50: error: Q213 has no meaning in CYCL DEF 205"},
      {"202 Q200=2", "1:1: error: CYCL DEF 202 has no Q201"},
      {"208 Q200=2", "1:1: error: CYCL DEF 208 is not simulated"},
  };
  for (const WrongHole& wrong : mistakes) {
    const auto lines =
        complaints(fmt::format("CYCL DEF {}\n", wrong.words), {}, Dialect::heidenhain);
    ASSERT_EQ(lines.size(), 1U) << wrong.words;
    EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint: ")), wrong.complaint);
    EXPECT_NE(lines[0].find(" (hint: "), std::string::npos) << lines[0];
  }
}

}  // namespace
}  // namespace frustum::parser

// CYCLE81 to CYCLE89 of Sinumerik and MCALL: every step of a hole.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "parser/interpret/cycles/drilling_steps.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_cycle(std::string_view text) {
  return motions(text, {}, Dialect::sinumerik);
}

struct Teller {
  AxisLetter depth = Z;
  [[nodiscard]] std::string operator()(const Traverse& m) const {
    return fmt::format("R{:g}", m.end[depth].value_or(999));
  }
  [[nodiscard]] std::string operator()(const LinearFeed& m) const {
    return fmt::format("F{:g}@{:g}{}", m.end[depth].value_or(999), m.feed.value,
                       m.feed.synchronised ? "s" : "");
  }
  [[nodiscard]] std::string operator()(const Dwell& m) const {
    return fmt::format("D{:g}", m.seconds);
  }
  [[nodiscard]] std::string operator()(const SpindleChange& m) const {
    constexpr std::array kWords{"M5", "M3", "M4"};
    return fmt::format("{}/{:g}", kWords.at(static_cast<std::size_t>(m.direction)), m.speed);
  }
  [[nodiscard]] std::string operator()(const Stop& m) const {
    return m.kind == StopKind::program_stop ? "M0" : "end";
  }
  [[nodiscard]] std::string operator()(const Event& m) const { return m.name; }
  template <typename Other>
  [[nodiscard]] std::string operator()(const Other& /*other*/) const {
    return "?";
  }
};

// The event that says whose strokes these are.
bool is_of_control(const Motion& motion) {
  const auto* event = std::get_if<Event>(&motion.command);
  return event != nullptr && (event->name == "CYCLE83" || event->name == "CYCLE84");
}

// What the hole's block does, from a tool at Z 50 over X 3 Y 4 with the spindle at 1000 and F 200:
// R and F to a height with the feed, D seconds, spindle and stops.
std::string cycle_steps(const std::string& call, const std::string& before = "",
                        AxisLetter depth = Z) {
  std::string told;
  for (const Motion& motion :
       run_cycle("G0 X3 Y4 Z50 S1000 M3 F200\n" + before + "\nN9 " + call + "\n")) {
    if (motion.place.line < 3 || is_of_control(motion)) continue;
    told += (told.empty() ? "" : " ") + std::visit(Teller{depth}, motion.command);
  }
  return told;
}

TEST(SinumerikCycles, TapInAFloatingChuckAsTheSpindleTurns) {
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,0,4,0,,1.5)"),
            "R12 F-15@1.5s M4/1000 F12@1.5s R40 M3/1000");
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,4,5,0,6)"),
            "R12 F-15@1s M4/1000 F12@1s R40 M5/1000");
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,3,4,0,,2)", "M4 S300"),
            "R12 F-15@2s M3/300 F12@2s R40 M4/300");
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,,,,,-2)", "M4 S300"),
            "CYCLE840 lead R12 F-15@2s M3/300 F12@2s R40 M4/300");
}

// ENC: 1 goes by the feed in force, or by the lead and 300 turns a minute.
TEST(SinumerikCycles, TapInAFloatingChuckWithoutAnEncoder) {
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,,25,,4,3,1)"),
            "R12 F-15@200 M4/1000 F12@200 R40 M3/1000");
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,3,4,1,,1.5)", "M4 S300"),
            "R12 F-15@450 M3/300 F12@450 R40 M4/300");
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,4,3,11,6)"),
            "CYCLE840 ENC R12 F-15@1000 M4/1000 F12@1000 R40 M3/1000");
  // No lead: there is no encoder.
  EXPECT_EQ(cycle_steps("CYCLE840(40,10,2,-15,,,4,3,0)"),
            "CYCLE840 R12 F-15@200 M4/1000 F12@200 R40 M3/1000");
}

TEST(SinumerikCycles, StrokesOfTheControlAreAssumed) {
  const auto assumed = [](const std::string& call) {
    std::vector<std::string> names;
    for (const Event& event : all_of<Event>(run_cycle("G0 X3 Y4 Z50 S1000 M3 F200\n" + call))) {
      if (event.grade == EventGrade::assumed) names.push_back(event.name);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(assumed("CYCLE83(40,10,2,-15,,4,,2,0,0,1,1)\n"), Names{"CYCLE83"});
  EXPECT_EQ(assumed("CYCLE83(40,10,2,-15,,-15,,2,0,0,1,1)\n"), Names{});
  EXPECT_EQ(assumed("CYCLE84(40,10,2,-15,,0,3,6,,0,300,300)\n"), Names{});
  EXPECT_EQ(assumed("CYCLE84(40,10,2,-15,,0,3,6,,0,300,300,0,0,0,1,5)\n"), Names{"CYCLE84"});
  EXPECT_EQ(assumed("HOLES1(0,0,0,10,10,3)\n"), Names{"HOLES1"});
  EXPECT_EQ(assumed("CYCLE801(0,0,0,10,10,3,3)\n"), Names{"CYCLE801"});
  EXPECT_EQ(assumed("HOLES2(0,0,10,0,60,6)\n"), Names{});
}

TEST(SinumerikCycles, DrillAndGoBack) {
  EXPECT_EQ(cycle_steps("CYCLE81(40, 10, 2, -15)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,,25)"), "R12 F-15@200 R40");
  // Relative goes before absolute; zero is none.
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-99,25)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-15,0)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,,-15)"), "R10 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,R1+10,1+1,-3*5)"), "R12 F-15@200 R40");
  // As the control's own editor writes it: dwell, plane, measure.
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-15,,0,0,1,12)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-99,25,0,0,1,11)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-15,25.5,0,0,1,12)"), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(4,1,0.1,-1)", "G700"), "R27.94 F-25.4@200 R101.6");
}

TEST(SinumerikCycles, Dwell) {
  EXPECT_EQ(cycle_steps("CYCLE82(40,10,2,-15,,1.5)"), "R12 F-15@200 D1.5 R40");
  // Below zero in turns of the spindle, or where the mode says so.
  EXPECT_EQ(cycle_steps("CYCLE82(40,10,2,-15,,-5)"), "R12 F-15@200 D0.3 R40");
  EXPECT_EQ(cycle_steps("CYCLE82(40,10,2,-15,,5,0,1,22)"), "R12 F-15@200 D0.3 R40");
  EXPECT_EQ(cycle_steps("CYCLE82(40,10,2,-15)"), "R12 F-15@200 R40");
}

TEST(SinumerikCycles, Peck) {
  // RFP 0, down to -20: 10, then 6 (10 - 4), then 4 left. Back to 0.6 above the last depth.
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,-20,,-10,,4,0,0,1,1)"),
            "R2 F-10@200 R2 R-9.4 F-16@200 R2 R-15.4 F-20@200 R40");
  // The retract that breaks the chip; dwells at every depth, half the feed for the first.
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,20,,10,4,0.5,9,0.5,0)"),
            "R2 F-10@100 D0.5 F-9@200 F-16@200 D0.5 F-15@200 F-20@200 D0.5 R40");
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,20,,10,4,0.5,0.2,1,1,3,0,0,2,1.5)"),
            "R2 F-10@200 D0.5 R2 D0.2 R-8.5 F-16@200 D0.5 R2 D0.2 R-14.5 F-20@200 D2 R40");
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,20,,10,4,0,0,1,0,3,0,2.5)"),
            "R2 F-10@200 F-7.5@200 F-16@200 F-13.5@200 F-20@200 R40");
  // Back to 0.6 above a depth of up to 30 mm, to a fiftieth of a deeper one.
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,50,,30,0,0,0,1,1)"), "R2 F-30@200 R2 R-29.4 F-50@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,100,,50,0,0,0,1,1)"),
            "R2 F-50@200 R2 R-49 F-75@200 R2 R-73.5 F-100@200 R40");
}

TEST(SinumerikCycles, PeckByTheModesOfTheCall) {
  // DAM and FRF per cent; 8, then half of it, then the least of 3, the last 5 shared.
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,20,,8,50,0,0.5,40,1,0,3,1.4,0,1.6,0,1,11211111)"),
            "CYCLE83 _AMODE R2 F-8@80 R2 D0.5 R-6.4 F-12@200 R2 D0.5 R-10.4 F-15@200 R2 D0.5 "
            "R-13.4 F-17.5@200 R2 D0.5 R-15.9 F-20@200 R40");
  // The first depth absolute beside a relative one; dwells in turns, 1000 a minute.
  EXPECT_EQ(cycle_steps("CYCLE83(40,0,2,,20,-12,5,0,50,100,1,1,0,0,0,25,1,0,1,22221)"),
            "R2 F-12@200 D3 R2 D6 R-11 F-20@200 D1.5 R40");
}

std::vector<double> strokes(double total, double first, double degression, double least = 0.0) {
  DrillingCycle cycle;
  cycle.bottom = -total;
  cycle.first = first;
  cycle.degression = degression;
  cycle.least = least;
  std::vector<double> all;
  double before = 0.0;
  for (const double depth : pecks(cycle)) {
    all.push_back(depth - before);
    before = depth;
  }
  return all;
}

TEST(SinumerikCycles, StrokesBecomeShorter) {
  using Strokes = std::vector<double>;
  EXPECT_EQ(strokes(100, 20, 0), (Strokes{20, 20, 20, 20, 10, 10}));
  EXPECT_EQ(strokes(50, 20, 0), (Strokes{20, 15, 15}));
  // 20, 15, 10, then 5 while more than 10 are left; the last two share.
  EXPECT_EQ(strokes(68, 20, 5), (Strokes{20, 15, 10, 5, 5, 5, 4, 4}));
  EXPECT_EQ(strokes(20, 20, 5), (Strokes{20}));
  // 15 would leave 2: the amount is left.
  EXPECT_EQ(strokes(37, 20, 5), (Strokes{20, 12, 5}));
  EXPECT_EQ(strokes(42, 16, -0.5, 6), (Strokes{16, 8, 6, 6, 3, 3}));
}

RC_GTEST_PROP(SinumerikCycleLaws, PecksEndAtTheBottom, ()) {
  const auto number = [](int from, int to) {
    return static_cast<double>(*rc::gen::inRange(from * 10, to * 10)) / 10.0;
  };
  const double total = number(1, 200);
  const double first = std::min(total, number(1, 100));
  const double amount = number(1, 20);
  const auto all = strokes(total, first, amount);
  RC_ASSERT(!all.empty());
  double sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    RC_ASSERT(all[i] > 0.0);
    if (i > 0) RC_ASSERT(all[i] <= std::max(all[i - 1], amount) + 1e-9);
    sum += all[i];
  }
  RC_ASSERT(std::abs(sum - total) < 1e-9);
}

TEST(SinumerikCycles, Tap) {
  EXPECT_EQ(cycle_steps("CYCLE84(40,10,2,-15,,0.5,3,6,,0,300,600)"),
            "R12 M3/300 F-15@1s D0.5 M4/600 F12@1s R40 M3/1000");
  // Left-handed by the sign of the lead; off afterwards without SDAC.
  EXPECT_EQ(cycle_steps("CYCLE84(40,10,2,-15,,,,,-1.25,,300)"),
            "R12 M4/300 F-15@1.25s M3/300 F12@1.25s R40 M5/1000");
  // 20 threads an inch.
  EXPECT_EQ(cycle_steps("CYCLE84(40,10,2,-15,,,3,,20,0,300,300,3,2)"),
            "R12 M3/300 F-15@1.27s M4/300 F12@1.27s R40 M3/1000");
}

// S 0 has come back after it.
TEST(SinumerikCycles, TapWithoutAnySpeedBeforeLeavesItsOwn) {
  const auto all = run_cycle("G0 X3 Y4 Z50\nCYCLE84(40,10,2,-15,,,3,,1.25,0,300,600)\n");
  EXPECT_EQ(last_of<SpindleChange>(all).direction, SpindleDirection::clockwise);
  EXPECT_EQ(last_of<SpindleChange>(all).speed, 600.0);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "CYCLE84 S");
  EXPECT_EQ(all_of<Event>(all).at(0).grade, EventGrade::assumed);
  // A spindle that stands has nothing to be told; M3 has the last speed there was.
  const auto off = run_cycle("G0 X3 Y4 Z50\nCYCLE84(40,10,2,-15,,,5,,1.25,0,300,600)\nM3\nG0 X9\n");
  EXPECT_EQ(last_of<SpindleChange>(off).speed, 600.0);
  EXPECT_TRUE(all_of<Event>(off).empty());
}

TEST(SinumerikCycles, TapInStrokes) {
  // 5, then the last 7 shared; back by 1, or out of the hole.
  EXPECT_EQ(cycle_steps("CYCLE84(40,0,2,-12,,,3,,1,0,300,600,3,0,0,1,5,1)"),
            "R2 M3/300 F-5@1s M4/600 F-4@1s M3/300 F-8.5@1s M4/600 F-7.5@1s M3/300 F-12@1s M4/600 "
            "F2@1s R40 M3/1000");
  EXPECT_EQ(cycle_steps("CYCLE84(40,0,2,-12,,,3,,1,0,300,600,3,0,0,2,5,1)"),
            "R2 M3/300 F-5@1s M4/600 F2@1s M3/300 F-4@1s F-8.5@1s M4/600 F2@1s M3/300 F-7.5@1s "
            "F-12@1s M4/600 F2@1s R40 M3/1000");
}

TEST(SinumerikCycles, WithoutAnyFeedIsTheControls) {
  const auto all = run_cycle("G0 X0 Y0 Z9\nCYCLE81(5,0,2,-5)\n");
  EXPECT_EQ(last_of<LinearFeed>(all).feed.value, 0.0);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "feed");
  EXPECT_EQ(all_of<Event>(all).at(0).grade, EventGrade::assumed);
}

TEST(SinumerikCycles, OfAModalCallAreLookedAtWhereAHoleIs) {
  EXPECT_TRUE(
      complaints("F9 G0 X0 Y0\nMCALL CYCLE81(5,10,2,-5)\nMCALL\nG0 X1\n", {}, Dialect::sinumerik)
          .empty());
}

TEST(SinumerikCycles, Bore) {
  EXPECT_EQ(cycle_steps("CYCLE85(40,10,2,-15,,1,100,150)"), "R12 F-15@100 D1 F12@150 R40");
  EXPECT_EQ(cycle_steps("CYCLE85(40,10,2,-15)"), "R12 F-15@200 F12@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE87(40,10,2,-15,,3)"), "R12 F-15@200 M5/1000 M0 R40");
  EXPECT_EQ(cycle_steps("CYCLE87(40,10,2,-15,,4)"), "R12 M4/1000 F-15@200 M5/1000 M0 R40");
  EXPECT_EQ(cycle_steps("CYCLE88(40,10,2,-15,,2,3)"), "R12 F-15@200 D2 M5/1000 M0 R40");
  EXPECT_EQ(cycle_steps("CYCLE89(40,10,2,-15,,2)"), "R12 F-15@200 D2 F12@200 R40");
  const std::string oriented = "CYCLE86(40,10,2,-15,,1,3,-0.5,0.25,1,45)";
  EXPECT_EQ(cycle_steps(oriented), "R12 F-15@200 D1 M5/1000 orient_spindle R-14 R12 R40");
  const auto moves = all_of<Traverse>(run_cycle("G0 X3 Y4 Z50 S1000 M3 F200\n" + oriented + "\n"));
  ASSERT_EQ(moves.size(), 5U);
  EXPECT_DOUBLE_EQ(*moves[2].end[X], 2.5);
  EXPECT_DOUBLE_EQ(*moves[2].end[Y], 4.25);
  EXPECT_DOUBLE_EQ(*moves[3].end[X], 2.5);
  EXPECT_DOUBLE_EQ(*moves[4].end[X], 3.0);
  EXPECT_DOUBLE_EQ(*moves[4].end[Y], 4.0);
}

TEST(SinumerikCycles, GoAlongTheNormalOfThePlane) {
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-15)", "G18", Y), "R12 F-15@200 R40");
  EXPECT_EQ(cycle_steps("CYCLE81(40,10,2,-15,,0,0,3,12)", "G19", X), "R12 F-15@200 R40");
  const auto all =
      run_cycle("G0 X3 Y4 Z50 S1000 M3 F200\nG18 CYCLE86(40,10,2,-15,,1,3,-0.5,0.25,1,45)\n");
  // The first axis of the plane is Z.
  EXPECT_DOUBLE_EQ(*all_of<Traverse>(all).at(2).end[Z], 49.5);
  EXPECT_DOUBLE_EQ(*all_of<Traverse>(all).at(2).end[X], 3.25);
}

std::vector<std::string> holes(const std::string& text) {
  std::vector<std::string> places;
  for (const LinearFeed& move : all_of<LinearFeed>(run_cycle(text))) {
    places.push_back(fmt::format("{:g},{:g}", *move.end[X], *move.end[Y]));
  }
  return places;
}
using Holes = std::vector<std::string>;

TEST(SinumerikCycles, AreCalledBehindEachMove) {
  const std::string head = "G0 X0 Y0 Z50 F200\n";
  EXPECT_EQ(holes(head + "MCALL CYCLE81(40,10,2,-15)\nX1 Y2\nM8\nX3\nMCALL\nX4\n"),
            (Holes{"1,2", "3,2"}));
  EXPECT_EQ(holes(head + "N5 MCALL CYCLE82(40,10,2,-15,,1)\nG111 X5 Y5\nAP=0 RP=5\nAP=90\nMCALL\n"),
            (Holes{"10,5", "5,10"}));
  // In a subprogram of places, and with another cycle from then on.
  EXPECT_EQ(
      holes(head + "MCALL CYCLE81(40,10,2,-15)\nL1\nMCALL CYCLE89(40,10,2,-5)\nL1\nMCALL\nM30\n"
                   "%_N_L1_SPF\nX1\nX2\nM17\n"),
      (Holes{"1,0", "2,0", "1,0", "1,0", "2,0", "2,0"}));
  // The feed is that in force at the hole.
  const auto feeds =
      all_of<LinearFeed>(run_cycle(head + "MCALL CYCLE81(40,10,2,-15)\nX1 F50\nX2 F70\n"));
  EXPECT_DOUBLE_EQ(feeds.at(0).feed.value, 50.0);
  EXPECT_DOUBLE_EQ(feeds.at(1).feed.value, 70.0);
  // In a swivelled and turned frame the depth is along its normal.
  const auto all = run_cycle(
      "CYCLE800(0,\"T\",0,57,0,0,0,30,0,0)\nROT Z90\nG0 X1 Y2 Z50 F100\nCYCLE81(40,10,2,-15)\n");
  EXPECT_NEAR(*last_of<LinearFeed>(all).end[X], -2.0, 1e-9);
  EXPECT_NEAR(*last_of<LinearFeed>(all).end[Z], -15.0, 1e-9);
}

TEST(SinumerikCycles, TellMistakes) {
  struct Mistake {
    const char* text;
    const char* complaint;
  };
  const Mistake mistakes[] = {
      {"CYCLE81\n", "1:1: error: CYCLE81 has no parameters"},
      {"CYCLE81(1,2\n", "1:1: error: the bracket of CYCLE81 is not closed"},
      {"CYCLE81(1 2)\n", "1:11: error: unexpected '2'"},
      {"CYCLE81(1,2,3,4,5,6,0,0,0,1)\n", "1:27: error: CYCLE81 has too many parameters"},
      {"CYCLE87(1,2,3,4,5,3,1)\n", "1:21: error: CYCLE87 has too many parameters"},
      {"CYCLE81(,0,2,-5)\n", "1:1: error: CYCLE81 has no RTP"},
      {"CYCLE81(5,,2,-5)\n", "1:1: error: CYCLE81 has no RFP"},
      {"CYCLE81(5,0,2)\n", "1:1: error: CYCLE81 has no depth"},
      {"CYCLE81(5,0,2,,,0,0,1,11)\n", "1:1: error: CYCLE81 has no depth"},
      {"CYCLE81(5,0,-2,-5)\n", "1:13: error: SDIS=-2 is negative"},
      {"CYCLE81(5,0,2,,-5)\n", "1:16: error: DPR=-5 is negative"},
      {"CYCLE81(5,0,2,5)\n", "1:15: error: the bottom of the hole (5 mm) is not below RFP (0 mm)"},
      {"CYCLE81(5,10,2,-5)\n", "1:9: error: RTP (5 mm) is below RFP (10 mm)"},
      {"CYCLE81(5,0,2,-5,,0,10)\n", "1:21: error: _GMODE=10 is not simulated"},
      {"CYCLE81(5,0,2,-5,,0,0,2)\n", "1:23: error: _DMODE=2 is another plane than that in force"},
      {"CYCLE81(5,0,2,-5,,0,0,1,1.5)\n", "1:25: error: _AMODE=1.5 is not a whole number"},
      {"CYCLE82(5,0,2,-5,,-3)\n", "1:19: error: a dwell in revolutions with no spindle speed"},
      {"CYCLE81(5,0,2,-5)\n",
       "1:1: error: the place of the hole is not known: X has not been programmed yet"},
      {"F0 G0 X0 Y0\nCYCLE81(5,0,2,-5)\n", "2:1: error: a cycle without a feed rate"},
      {"F9 G0 X0 Y0\nMCALL CYCLE81(5,10,2,-5)\nX1\n",
       "2:15: error: RTP (5 mm) is below RFP (10 mm)"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,0,1,0,0,0,0,0,0,0,1,3000000)\n",
       "1:46: error: _AMODE=3000000 is not simulated"},
      {"CYCLE83(5,0,2,-5,,,1,101,0,0,1,0,0,0,0,0,0,0,1,200000)\n",
       "1:22: error: DAM=101 is no factor"},
      {"CYCLE84(5,0,2,-5,,,3,6,,,100,,,,,1,9)\n",
       "1:36: error: the first depth of CYCLE84 is not within the hole"},
      {"G0 X0 Y0 G93\nCYCLE81(5,0,2,-5) F5\n", "2:1: error: a cycle in G93"},
      {"F9 G0 X0 Y0\nMCALL CYCLE81(5,0,2,-5)\nG0 SUPA D0 X1\n",
       "3:1: error: the place of the hole is not known: X is not known since the move in machine "
       "coordinates (SUPA) on line 3"},
      {"MIRROR Z0\nF9 G0 X0 Y0\nCYCLE81(5,0,2,-5)\n",
       "3:1: error: a cycle where the depths are scaled or mirrored"},
      {"SCALE X2 Y2 Z2\nF9 G0 X0 Y0\nCYCLE81(5,0,2,-5)\n",
       "3:1: error: a cycle where the depths are scaled or mirrored"},
      {"T1 D1 M6\nTRAORI\nF9 G0 X0 Y0 Z0 A3=0 C3=1\nCYCLE81(5,0,2,-5)\n",
       "4:1: error: a cycle with a tool vector"},
      {"CYCLE83(5,0,2,-5)\n", "1:1: error: the first depth of CYCLE83 is not within the hole"},
      {"CYCLE83(5,0,2,-5,,-6)\n", "1:19: error: the first depth of CYCLE83 is not within the hole"},
      {"CYCLE83(5,0,2,-5,,,1,-1)\n", "1:22: error: DAM=-1 is no factor"},
      {"CYCLE83(5,0,2,-5,,,1,-0.5)\n", "1:1: error: the cycle makes more than 10000 pecks"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,0,2)\n", "1:28: error: FRF=2 is out of range"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,0,1,2)\n", "1:30: error: VARI=2 is out of range"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,-1)\n",
       "1:26: error: a dwell in revolutions with no spindle speed"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,0,1,0,,-1)\n", "1:33: error: _MDEP=-1 is negative"},
      {"CYCLE83(5,0,2,-5,,,1,0,0,0,1,0,1)\n", "1:32: error: _AXN=1 drills across the plane"},
      {"CYCLE84(5,0,2,-5)\n", "1:1: error: CYCLE84 has no lead"},
      {"CYCLE84(5,0,2,-5,,,3,7)\n", "1:22: error: MPIT=7 is no metric thread"},
      {"CYCLE84(5,0,2,-5,,,3,6)\n", "1:1: error: CYCLE84 has no spindle speed"},
      {"CYCLE84(5,0,2,-5,,,7,6,,,100)\n", "1:20: error: SDAC=7 is out of range"},
      {"CYCLE85(5,0,2,-5,,,-1)\n", "1:20: error: FFR=-1 is negative"},
      {"CYCLE87(5,0,2,-5,,2)\n", "1:19: error: SDIR=2 is out of range"},
      {"MCALL L10\n", "1:1: error: MCALL L10 is not simulated"},
      {"MCALL HOLES1(0,0,0,10,5,3)\n", "1:1: error: MCALL HOLES1 is not simulated"},
      {"HOLES2(0,0,10,10,5)\n", "1:1: error: HOLES2 has no number of holes"},
      {"CYCLE840(5,0,2,-5,,,,,,6)\n", "1:1: error: CYCLE840 while the spindle is at rest"},
      {"CYCLE840(5,0,2,-5)\n", "1:1: error: CYCLE840 without an encoder has no SDR"},
      {"CYCLE840(5,0,2,-5,,,1)\n", "1:21: error: SDR=1 is no direction"},
      {"CYCLE840(5,0,2,-5,,,4,3,2,6)\n", "1:25: error: ENC=2 is not known"},
      {"S9 M3 CYCLE840(5,0,2,-5,,,3,3,0,6)\n",
       "1:7: error: CYCLE840 comes back as the spindle turns on the way in (SDR)"},
      {"CYCLE840(5,0,2,-5,,,0,3,0,7)\n", "1:27: error: MPIT=7 is no metric thread"},
      {"G0 X0 Y0 CYCLE81(5,0,2,-5)\n", "1:4: error: X0 has no meaning in this block"},
      {"CYCLE81(5,0,2,-5) CYCLE82(5,0,2,-5)\n", "1:19: error: CYCLE82 beside another cycle"},
  };
  for (const Mistake& mistake : mistakes) {
    const auto lines = complaints(mistake.text, {}, Dialect::sinumerik);
    ASSERT_FALSE(lines.empty()) << mistake.text;
    EXPECT_NE(lines[0].find(" (hint: "), std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint: ")), mistake.complaint) << mistake.text;
  }
}

}  // namespace
}  // namespace frustum::parser

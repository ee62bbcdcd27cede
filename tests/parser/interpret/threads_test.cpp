// Moves that follow the spindle, and probing: LinuxCNC's G33, G33.1, G76, G38.2 to G38.5; G7.
#include <gtest/gtest.h>

#include "parser/interpret/cycles/threading_cycle.hpp"
#include "parser/writing/canonical_json.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

std::vector<Motion> run_threading(const std::string& text) {
  return motions(text, {}, Dialect::linuxcnc);
}

TEST(Threads, FollowTheSpindleByTheLeadOfTheBlock) {
  const auto feeds =
      all_of<LinearFeed>(run_threading("S100 M3\nG0 X0 Z0\nG33 Z-5 K1.5\nG20 Z-1 K0.1\nM2\n"));
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_TRUE(feeds[0].feed.synchronised);
  EXPECT_EQ(feeds[0].feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(feeds[0].feed.value, 1.5);
  EXPECT_NEAR(feeds[1].feed.value, 2.54, 1e-12);
}

TEST(Threads, ARigidTapComesBackWithTheSpindleReversed) {
  const auto all = run_threading("S100 M4\nG0 X1 Y2 Z3\nG33.1 Z-5 K1\nM2\n");
  const auto feeds = all_of<LinearFeed>(all);
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].end[AxisLetter::Z], -5.0);
  EXPECT_EQ(feeds[1].end[AxisLetter::Z], 3.0);
  const auto spindle = all_of<SpindleChange>(all);
  ASSERT_EQ(spindle.size(), 3U);
  EXPECT_EQ(spindle[1].direction, SpindleDirection::clockwise);
  EXPECT_EQ(spindle[2].direction, SpindleDirection::counterclockwise);
}

TEST(ThreadingCycleLaws, EachPassIsDeeperAndTheLastOnesAreAtFullDepth) {
  for (int i = 1; i <= 200; ++i) {
    const double share = 0.02 * (1 + i % 40);
    ThreadingCycle cycle{.start_x = 20.0, .start_z = 1.0, .end_z = -30.0, .lead = 1.5};
    cycle.crest = i % 2 == 0 ? -1.0 : 1.0;
    cycle.full_depth = 0.5 + 0.01 * i;
    cycle.first_depth = std::min(share, 1.0) * cycle.full_depth;
    cycle.degression = 1.0 + 0.01 * i;
    cycle.slide_angle = 0.005 * (i % 100);
    cycle.spring_passes = i % 4;
    const double side = cycle.crest < 0.0 ? -1.0 : 1.0;
    double depth = 0.0;
    int full = 0;
    for (const ThreadMove& move : moves_of(cycle)) {
      if (move.lead == 0.0) continue;
      const double now = side * (move.x - cycle.start_x) - 1.0;
      EXPECT_GE(now, depth - 1e-9);
      depth = now;
      full += std::abs(now - cycle.full_depth) < 1e-9 ? 1 : 0;
      EXPECT_GE(move.z, cycle.end_z - 1e-9);
    }
    EXPECT_EQ(full, 1 + cycle.spring_passes);
    EXPECT_EQ(moves_of(cycle).back().x, cycle.start_x);
    EXPECT_EQ(moves_of(cycle).back().z, cycle.end_z);
  }
}

TEST(Probing, IsAMotionOfItsOwnAndLeavesItsPlaceInParameters) {
  const auto all = run_threading(
      "#5070=1\nG0 X1 Y2 Z3 A30\nG38.4 Z-5 F50\nG0 X[#5061+10] Y[#5063] Z[#5064+#5070]\nM2\n");
  const auto probe = last_of<Probe>(all);
  EXPECT_TRUE(probe.away);
  EXPECT_TRUE(probe.must_meet);
  EXPECT_EQ(probe.end[AxisLetter::Z], -5.0);
  EXPECT_EQ(probe.feed.value, 50.0);
  const auto rapid = last_of<Traverse>(all);
  EXPECT_EQ(rapid.end[AxisLetter::X], 11.0);
  EXPECT_EQ(rapid.end[AxisLetter::Y], -5.0);
  EXPECT_NEAR(*rapid.end[AxisLetter::Z], 30.0, 1e-12);
}

TEST(Probing, IsPublishedAsJson) {
  const auto all = run_threading("S9 M3 F50\nG0 X1 Z3\nG38.3 Z-5\nG33 X2 K1\nM2\n");
  std::vector<std::string> lines;
  for (const Motion& motion : all) lines.push_back(to_json_line(motion));
  ASSERT_GE(lines.size(), 4U);
  EXPECT_EQ(
      lines[2],
      R"({"line":3,"type":"probe","end":{"X":1.0,"Z":-5.0},"away":false,"must_meet":false,"feed":50.0})");
  EXPECT_EQ(lines[3], R"({"line":4,"type":"feed","end":{"X":2.0,"Z":-5.0},"feed":1.0,)"
                      R"("feed_mode":"per_revolution","synchronised":true})");
}

TEST(Diameters, AreHalvedInXAloneWhileG7IsOn) {
  const auto rapids = all_of<Traverse>(run_threading("G7\nG0 X10 Z4\nG91 X2\nG90 G8 X3\nM2\n"));
  ASSERT_EQ(rapids.size(), 3U);
  EXPECT_EQ(rapids[0].end[AxisLetter::X], 5.0);
  EXPECT_EQ(rapids[0].end[AxisLetter::Z], 4.0);
  EXPECT_EQ(rapids[1].end[AxisLetter::X], 6.0);
  EXPECT_EQ(rapids[2].end[AxisLetter::X], 3.0);
}

struct ThreadMistake {
  const char* text;
  const char* complaint;
};

TEST(ThreadErrors, TellPlaceAndReason) {
  const std::string start = "F100 S100 M3\nG0 X10 Y0 Z5\n";
  for (const ThreadMistake& mistake : {
           ThreadMistake{"G33 Z-5\n", "3:1: error: G33 without K"},
           ThreadMistake{"G33 Z-5 K0\n", "3:9: error: K0 is not above zero"},
           ThreadMistake{"G33 K1\n", "3:1: error: a thread without an end"},
           ThreadMistake{"M5\nG33 Z-5 K1\n", "4:1: error: G33 while the spindle is at rest"},
           ThreadMistake{"G33 Z-5 K1\nZ-6\n", "4:1: error: a thread without K"},
           ThreadMistake{"G33.1 Z-5 K1 A5\n", "3:14: error: A5 has no meaning in this block"},
           ThreadMistake{"G33.1 K1\n", "3:1: error: a thread without an end"},
           ThreadMistake{
               "G55\nG33.1 Z-5 K1\n",
               "4:1: error: the tap goes back to a start that is not known: Z is not known"},
           ThreadMistake{"G76 Z-5 I-1 J0.1 K1\n", "3:1: error: the threading cycle has no P"},
           ThreadMistake{"G76 P1 Z-5 I0 J0.1 K1\n", "3:12: error: the crest is on the drive line"},
           ThreadMistake{"G76 P1 Z-5 I-1 J-0.1 K1\n", "3:16: error: J-0.1 is not above zero"},
           ThreadMistake{"G76 P1 Z-5 I-1 J2 K1\n",
                         "3:16: error: the first depth is more than the full"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 Q90\n", "3:24: error: Q90 is out of range"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 H-1\n", "3:24: error: H-1 is out of range"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 L4\n", "3:24: error: L4 is out of range"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 E-1\n", "3:24: error: E-1 is negative"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 E6 L3\n",
                         "3:24: error: the tapers are longer than the thread"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.0001 K10 R9\n",
                         "3:16: error: the thread would take more than 10000 passes"},
           ThreadMistake{"G76 P1 Z-5 I-1 J0.1 K1 A3\n",
                         "3:24: error: A3 has no meaning in this block"},
           ThreadMistake{"G55\nG76 P1 Z-5 I-1 J0.1 K1\n",
                         "4:1: error: the threading cycle starts at an unknown X: X is not known"},
           ThreadMistake{"M5\nG76 P1 Z-5 I-1 J0.1 K1\n",
                         "4:1: error: G76 while the spindle is at rest"},
           ThreadMistake{"G38.2 X10\n", "3:1: error: the probing move ends where it starts"},
           ThreadMistake{"G93 G38.2 Z-5\n", "3:5: error: a probing move without F in G93"},
           ThreadMistake{"F0\nG38.2 Z-5\n", "4:1: error: a probing move without a feed rate"},
           ThreadMistake{"G38.1 Z-5\n", "3:1: error: unknown word G38.1"},
           ThreadMistake{"M61\n", "3:1: error: M61 without a tool"},
           ThreadMistake{"M61 Q-1\n", "3:5: error: Q-1 is out of range"},
           ThreadMistake{"G17.1\n", "3:1: error: G17.1 is not simulated"},
           ThreadMistake{"G71 P1\n", "3:1: error: G71 is not simulated"},
           ThreadMistake{"G7 G8\n", "3:4: error: G7 and G8 contradict each other in a block"},
           ThreadMistake{"G18 G1 @5 ^3\n",
                         "3:8: error: a polar position outside the plane of X and Y"},
       }) {
    const auto lines = complaints(start + mistake.text, {}, Dialect::linuxcnc);
    ASSERT_FALSE(lines.empty()) << mistake.text;
    EXPECT_TRUE(lines.front().starts_with(mistake.complaint)) << mistake.text << lines.front();
    EXPECT_NE(lines.front().find("(hint: "), std::string::npos) << lines.front();
  }
}

TEST(BlanksOfLinuxcnc, DoNotCountButErrorsTellTheLineAsWritten) {
  const auto moves = all_of<Traverse>(run_threading("g 0 x 1 . 5 y [ a b s [ - 2 ] ]\nM 2\n"));
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].end[AxisLetter::X], 1.5);
  EXPECT_EQ(moves[0].end[AxisLetter::Y], 2.0);
  EXPECT_TRUE(complaints("G0 X 1 . 5 J7\n", {}, Dialect::linuxcnc)
                  .front()
                  .starts_with("1:12: error: J7 has no meaning in this block"));
  EXPECT_TRUE(complaints("G0 X1 5 Y[1/0]\n", {}, Dialect::linuxcnc).front().starts_with("1:12: "))
      << complaints("G0 X1 5 Y[1/0]\n", {}, Dialect::linuxcnc).front();
  EXPECT_TRUE(
      complaints("G0 X1 5 Y]\n", {}, Dialect::linuxcnc).front().starts_with("1:7: error: "));
}

}  // namespace
}  // namespace frustum::parser

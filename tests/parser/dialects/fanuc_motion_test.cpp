// G27 to G33 of Fanuc: reference points, skips, threads.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

TEST(FanucReferencePoint, IsCheckedBehindARapidMove) {
  const auto all = motions("G0 X1 Y2\nG27 X5 Z-3\nG1 X6 F100\n");
  const auto rapids = all_of<Traverse>(all);
  ASSERT_EQ(rapids.size(), 2U);
  EXPECT_EQ(rapids[1].end[X], 5.0);
  EXPECT_EQ(rapids[1].end[Y], 2.0);
  EXPECT_EQ(rapids[1].end[Z], -3.0);
  const Event check = last_of<Event>(all);
  EXPECT_EQ(check.name, "G27");
  EXPECT_EQ(check.text, "XZ");
}

TEST(FanucReferencePoint, IsLeftByThePlaceThatLedThere) {
  const auto all = motions("G90 G0 X1 Y2 Z3\nG28 X10 Z30\nT2 M6\nG29 X50 Z5\n");
  const auto rapids = all_of<Traverse>(all);
  ASSERT_EQ(rapids.size(), 4U);
  EXPECT_EQ(rapids[2].end[X], 10.0);
  EXPECT_EQ(rapids[2].end[Z], 30.0);
  EXPECT_EQ(rapids[3].end[X], 50.0);
  EXPECT_EQ(rapids[3].end[Y], 2.0);
  EXPECT_EQ(rapids[3].end[Z], 5.0);
  // Steps count from that place; at it the way ends.
  const auto steps = all_of<Traverse>(motions("G90 G0 Z3\nG28 Z30\nG91 G29 Z-7\n"));
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(steps[2].end[Z], 30.0);
  EXPECT_EQ(steps[3].end[Z], 23.0);
  EXPECT_EQ(all_of<Traverse>(motions("G90 G0 Z3\nG28 Z30\nG29 Z30\n")).size(), 3U);
}

TEST(FanucSkip, IsAProbingMoveThatMayMeetNothing) {
  const auto all = motions("G90 G1 X0 Y0 Z5 F500\nG31 Z-10 F50\n#1=#5063\nX#1\n");
  const Probe skip = last_of<Probe>(all);
  EXPECT_EQ(skip.end[Z], -10.0);
  EXPECT_EQ(skip.end[X], 0.0);
  EXPECT_EQ(skip.feed.value, 50.0);
  EXPECT_FALSE(skip.away);
  EXPECT_FALSE(skip.must_meet);
  // It holds for its block alone: the next one is G1 again, to where the skip ended.
  const LinearFeed next = last_of<LinearFeed>(all);
  EXPECT_EQ(next.end[X], -10.0);
  EXPECT_EQ(next.end[Z], -10.0);
}

TEST(FanucThread, FollowsTheSpindleByTheLeadF) {
  const auto cuts =
      all_of<LinearFeed>(motions("G90 G0 X0 Z5\nS100 M3\nG33 Z-10 F1.5\nZ-12\nG20 G33 Z-1 F0.1\n"));
  ASSERT_EQ(cuts.size(), 3U);
  for (const LinearFeed& cut : cuts) {
    EXPECT_TRUE(cut.feed.synchronised);
    EXPECT_EQ(cut.feed.mode, FeedMode::per_revolution);
  }
  EXPECT_EQ(cuts[0].end[Z], -10.0);
  EXPECT_EQ(cuts[0].feed.value, 1.5);
  EXPECT_EQ(cuts[1].feed.value, 1.5);
  EXPECT_DOUBLE_EQ(cuts[2].feed.value, 2.54);
  EXPECT_DOUBLE_EQ(*cuts[2].end[Z], -25.4);
}

// NUM and other ISO controls have the centre itself in G90; the first arc tells.
TEST(FanucMotion, FirstArcShowsCentresThatAreNoSteps) {
  const auto all = motions("G0 X10 Y0 Z0\nG3 X0 Y10 I0 J0 F100\nG3 X-10 Y0 I0 J0\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 2U);
  for (const ArcFeed& arc : arcs) EXPECT_NEAR(arc.center.head<2>().norm(), 0.0, 1e-12);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "arc centres");
  // Not after an arc whose centre was a step, nor after G91.1, nor where the radii nearly agree.
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 X0 Y10 I-10 J0 F100\nG3 X-10 Y0 I2 J0\n"),
            std::vector<std::string>{"arc-radius"});
  EXPECT_EQ(complaint_ids("G91.1\nG0 X10 Y0\nG3 X0 Y10 I5 J5 F100\n"),
            std::vector<std::string>{"arc-radius"});
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 X-10 Y0 I-10.02 J0 F100\n"),
            std::vector<std::string>{"arc-radius"});
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 I0 J0 F100\n"),
            std::vector<std::string>{"arc-centre-is-start"});
}

}  // namespace
}  // namespace frustum::parser

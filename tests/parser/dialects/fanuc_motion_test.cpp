// Moves of Fanuc: reference points, skips, threads, arcs, radius compensation.
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
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 X-10 Y0 I-10.2 J0 F100\n"),
            std::vector<std::string>{"arc-radius"});
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 I0 J0 F100\n"),
            std::vector<std::string>{"arc-centre-is-start"});
}

// The start is 10.05 mm from the centre, the end 9.95 mm: 0.1 mm apart.
TEST(FanucMotion, RadiiThatNearlyAgreeMakeASpiral) {
  const auto all = motions("G0 X10 Y0 Z0\nG3 X-9.9 Y0 I-10 J0 F100\n");
  EXPECT_EQ(last_of<ArcFeed>(all).end[X], -9.9);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "arc radii");
  EXPECT_EQ(all_of<Event>(all).at(0).grade, EventGrade::assumed);
  EXPECT_EQ(complaint_ids("G0 X10 Y0\nG3 X-9.8 Y0 I-10 J0 F100\n"),
            std::vector<std::string>{"arc-radius"});
  // Of a radius of 0.5 mm it is too much.
  EXPECT_EQ(complaint_ids("G0 X0.5 Y0\nG3 X-0.45 Y0 I-0.5 J0 F100\n"),
            std::vector<std::string>{"arc-radius"});
}

// Half a turn of a helix with the pitch 3 rises by 1.5 mm, one and a half by 4.5 mm.
TEST(FanucMotion, HelixMayHaveItsPitchBesideItsEnd) {
  const auto all = motions("G0 X5 Y0 Z0\nG3 X-5 Y0 Z1.5 I-5 J0 K3 F100\n");
  EXPECT_EQ(last_of<ArcFeed>(all).end[Z], 1.5);
  EXPECT_EQ(last_of<ArcFeed>(all).turns, 1);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "pitch");
  EXPECT_EQ(last_of<ArcFeed>(motions("G0 X5 Y0 Z0\nG2 X-5 Y0 Z-4.5 I-5 J0 K3 P2 F100\n")).turns,
            -2);
  EXPECT_EQ(last_of<ArcFeed>(motions("G0 X5 Y0 Z0\nG3 X5 Y0 Z3 I-5 J0 K3 F100\n")).end[Z], 3.0);
  EXPECT_EQ(last_of<ArcFeed>(motions("G19 G0 Y5 Z0 X0\nG3 Y-5 Z0 X1 J-5 K0 I2 F9\n")).end[X], 1.0);
  using Ids = std::vector<std::string>;
  EXPECT_EQ(complaint_ids("G0 X5 Y0 Z0\nG3 X-5 Y0 Z1.6 I-5 J0 K3 F100\n"), Ids{"word-unused"});
  EXPECT_EQ(complaint_ids("G0 X5 Y0 Z0\nG3 X-5 Y0 I-5 J0 K3 F100\n"), Ids{"word-unused"});
}

// To the side of a tool that may be tilted: as G41 while nothing says how far.
TEST(FanucMotion, CompensationInSpaceNeedsAToolWithoutDiameter) {
  const char* text = "G0 X0 Y0\nG1 G41.2 D4 X10 F100\nY5\nG40 X0\n";
  const auto all = motions(text);
  EXPECT_EQ(all_of<LinearFeed>(all).at(0).end[X], 10.0);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "cutter radius");
  InterpreterOptions options;
  options.tools[4].diameter = 6.0;
  EXPECT_EQ(complaint_ids(text, options), std::vector<std::string>{"not-simulated"});
}

// Radius 5 mm and its wear of 0.25 mm, to the left of a contour along Y.
TEST(FanucMotion, WearOfTheRadiusCounts) {
  const std::string contour = "G0 X0 Y0\nG1 G41 D1 X10 F100\nY5\nY10\nG40 X0\n";
  const auto all = motions("G10 L12 P1 R5\nG10 L13 P1 R0.25\n" + contour);
  EXPECT_NEAR(*all_of<LinearFeed>(all).at(1).end[X], 4.75, 1e-9);
  // A length alone leaves the radius open, which is told.
  const auto open = motions("G10 L10 P1 R50\n" + contour);
  EXPECT_EQ(all_of<LinearFeed>(open).at(1).end[X], 10.0);
  EXPECT_EQ(all_of<Event>(open).at(0).name, "cutter radius");
}

// A wear adds to what nobody has given, and a length is no radius.
TEST(FanucMotion, WearOrLengthAloneGivesNoRadius) {
  using Texts = std::vector<std::string>;
  const std::string contour = "G0 X0 Y0\nG1 G41 D2 X10 F100\nY5\nY10\nG40 X0\n";
  InterpreterOptions options;
  options.tools[1].diameter = 8.0;
  const auto message = [&](const std::string& setting) {
    const Texts lines = complaints(setting + contour, options);
    return lines.size() == 1 ? lines.front().substr(0, lines.front().find(" (hint: ")) : "";
  };
  EXPECT_EQ(message("G21 G10 L13 P2 R0.3\n"), "3:8: error: nothing gives the diameter of tool 2");
  EXPECT_EQ(message("#13002=0.3\n"), "3:8: error: nothing gives the diameter of tool 2");
  EXPECT_EQ(message("G10 L10 P2 R80\n"), "3:8: error: nothing gives the diameter of tool 2");
  EXPECT_EQ(message("#10002=80\n"), "3:8: error: nothing gives the diameter of tool 2");
  // To the wear in the program the job's diameter counts; zero is a radius too.
  EXPECT_NEAR(*all_of<LinearFeed>(motions("G10 L13 P1 R0.3\nG0 X0 Y0\nG1 G41 D1 X10 F100\nY5\n"
                                          "Y10\nG40 X0\n",
                                          options))
                   .at(1)
                   .end[X],
              5.7, 1e-9);
  EXPECT_EQ(all_of<LinearFeed>(motions("G10 L12 P2 R0\n" + contour, options)).at(1).end[X], 10.0);
  // Steps need what they add to.
  EXPECT_EQ(complaint_ids("G91 G10 L12 P2 R0.1\n", options), Texts{"unknown-tool-radius"});
  EXPECT_TRUE(complaint_ids("G91 G10 L12 P1 R0.1\n", options).empty());
  // Lengths alone of a setup leave all radii open.
  InterpreterOptions lengths;
  Tool& tool = entry_of(lengths.tools, 2);
  tool.offset[2] = 80.0;
  tool.has_length = true;
  const auto open = motions("G21\n" + contour, lengths);
  EXPECT_EQ(all_of<LinearFeed>(open).at(1).end[X], 10.0);
  ASSERT_EQ(all_of<Event>(open).size(), 1U);
  EXPECT_EQ(all_of<Event>(open).at(0).name, "cutter radius");
}

TEST(FanucMotion, WearAloneGivesNoLength) {
  using Ids = std::vector<std::string>;
  EXPECT_EQ(complaint_ids("G10 L11 P2 R0.3\nG43 H2 Z5\n"), Ids{"unknown-tool-length"});
  EXPECT_EQ(complaint_ids("#11002=0.3\nG43 H2 Z5\n"), Ids{"unknown-tool-length"});
  EXPECT_EQ(complaint_ids("G91 G10 L10 P2 R0.3\n"), Ids{"unknown-tool-length"});
  const auto both = motions("#10002=80\n#11002=0.3\nG43 H2 Z5\n");
  EXPECT_EQ(last_of<CompensationChange>(both).length, 80.3);
}

// The parameters of the control say whether offsets are radii.
TEST(FanucMotion, OffsetsOfRadiiAreTold) {
  const auto told = [](std::string_view text) {
    std::vector<std::string> names;
    for (const Event& event : all_of<Event>(motions(text))) {
      if (event.grade == EventGrade::assumed) names.push_back(event.name);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  for (const char* text : {"G21 G10 L12 P1 R5\nG10 L13 P1 R1\n", "G21 G10 L13 P1 R0.1\n",
                           "G21\n#12001=5\n", "G21\n#13001=0.1\n"}) {
    EXPECT_EQ(told(text), Names{"offset memory"}) << text;
  }
  for (const char* text : {"G21 G10 L13 P1 R0\n", "G21\n#13001=0\n", "G21 G10 L10 P1 R50\n"}) {
    EXPECT_TRUE(told(text).empty()) << text;
  }
}

}  // namespace
}  // namespace frustum::parser

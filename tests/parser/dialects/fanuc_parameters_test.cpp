// What parameters of Fanuc decide, and how it is taken: numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "parser/writing/motion_writer.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;
using AssumedNames = std::vector<std::string>;

constexpr const char* kHead = "G21 G90 G17 G94 S1000 M3 F100\nG0 X0 Y0 Z10\n";

std::vector<Motion> after_head(const std::string& text, const InterpreterOptions& options = {}) {
  return motions(kHead + text, options);
}
double x_at_end_of(const std::string& text) {
  return last_of<LinearFeed>(after_head(text)).end[X].value_or(NAN);
}
AssumedNames assumed_in(const std::vector<Motion>& all) {
  AssumedNames names;
  for (const Event& event : all_of<Event>(all)) {
    if (event.grade == EventGrade::assumed) names.push_back(event.name);
  }
  return names;
}

TEST(FanucParameters, RoundGoesToTheLeastIncrementInAnAddress) {
  EXPECT_EQ(x_at_end_of("#1=1.2345\nG1 X[ROUND[#1]]\n"), 1.235);
  EXPECT_NEAR(x_at_end_of("G1 X[ROUND[1.23456]+ROUND[2.34567]]\n"), 3.581, 1e-12);
  EXPECT_EQ(x_at_end_of("#2=ROUND[2.6]\nG1 X#2\n"), 3.0);
  EXPECT_EQ(x_at_end_of("IF [ROUND[1.4] EQ 1] THEN #3=7\nG1 X#3\n"), 7.0);
  // The examples of the Haas manual, in inches and degrees.
  const auto inches =
      all_of<LinearFeed>(motions("G20 G90 F10\n#1=1.00333\nG1 X[#1+#1] A[#1+#1]\n"
                                 "X[ROUND[#1]+ROUND[#1]] A[ROUND[#1]+ROUND[#1]]\n"));
  EXPECT_NEAR(*inches.at(0).end[X] / 25.4, 2.0067, 1e-12);
  EXPECT_NEAR(*inches.at(1).end[X] / 25.4, 2.0066, 1e-12);
  EXPECT_NEAR(*inches.at(0).end[A] * 180.0 / std::numbers::pi, 2.007, 1e-12);
  EXPECT_NEAR(*inches.at(1).end[A] * 180.0 / std::numbers::pi, 2.006, 1e-12);
}

TEST(FanucParameters, ComputedWordsAreRounded) {
  const auto all = after_head("#2=10/3\nG91 G1 X#2\nX#2\nX#2\n");
  EXPECT_NEAR(*last_of<LinearFeed>(all).end[X], 9.999, 1e-12);
  EXPECT_EQ(assumed_in(all), AssumedNames{"least increment"});
  // Numbers as they are written, and other controls, are not rounded.
  EXPECT_EQ(x_at_end_of("G1 X3.33333\n"), 3.33333);
  const auto linuxcnc = motions("G21 G90\n#2=[10/3]\nG1 X#2 F100\nM2\n", {}, Dialect::linuxcnc);
  EXPECT_NEAR(*last_of<LinearFeed>(linuxcnc).end[X], 10.0 / 3.0, 1e-12);
}

TEST(FanucParameters, AnglesOfAtanAndAsinAreFromZero) {
  EXPECT_NEAR(x_at_end_of("#1=ATAN[-1]/[-1]\nG1 X#1\n"), 225.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ATAN[-1]/[1]\nG1 X#1\n"), 315.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ATAN[1]/[-1]\nG1 X#1\n"), 135.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ATAN[-1]\nG1 X#1\n"), -45.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ASIN[-1]\nG1 X#1\n"), 270.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ASIN[-.5]\nG1 X#1\n"), 330.0, 1e-12);
  EXPECT_NEAR(x_at_end_of("#1=ASIN[.5]\nG1 X#1\n"), 30.0, 1e-12);
  EXPECT_EQ(assumed_in(after_head("#1=ATAN[-1]/[-1]\n#2=ASIN[-1]\n")),
            AssumedNames{"angle from zero"});
  EXPECT_TRUE(assumed_in(after_head("#1=ATAN[1]/[-1]\n#2=ASIN[1]\n")).empty());
}

TEST(FanucParameters, InverseTimeOfAnArcIsSpeedOverRadius) {
  // 10 mm/min along 5 pi mm: 94.2 s.
  const auto all = after_head("G93 G2 X10. Y0. I5. J0. F2.\n");
  const Feed feed = last_of<ArcFeed>(all).feed;
  EXPECT_EQ(feed.mode, FeedMode::inverse_time);
  EXPECT_NEAR(60.0 / feed.value, 60.0 * 5.0 * std::numbers::pi / 10.0, 1e-9);
  EXPECT_EQ(assumed_in(all), AssumedNames{"arc in G93"});
  // A full circle, in inches: the radius is in inches too.
  const auto inches = motions("G20 G90 G0 X0 Y0 Z0\nG93 G3 I-2. F3.\n");
  EXPECT_NEAR(last_of<ArcFeed>(inches).feed.value, 3.0 / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_EQ(last_of<LinearFeed>(after_head("G93 G1 X10. F2.\n")).feed.value, 2.0);
  const auto linuxcnc =
      motions("G21 G90 G0 X0 Y0 Z10\nG93 G2 X10. Y0. I5. J0. F2.\nM2\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(last_of<ArcFeed>(linuxcnc).feed.value, 2.0);
}

TEST(FanucParameters, FeedOfAHelixIsAlongItsArc) {
  // 15 mm down along 5 pi mm: sqrt(1 + (3 / pi)^2).
  const double factor = std::hypot(1.0, 3.0 / std::numbers::pi);
  const auto all = after_head("G2 X10. Y0. I5. J0. Z-5. F100.\nG2 X0 I-5.\nG1 Y5\n");
  EXPECT_NEAR(all_of<ArcFeed>(all).at(0).feed.value, 100.0 * factor, 1e-9);
  EXPECT_EQ(all_of<ArcFeed>(all).at(1).feed.value, 100.0);
  EXPECT_EQ(last_of<LinearFeed>(all).feed.value, 100.0);
  EXPECT_EQ(assumed_in(all), AssumedNames{"helix feed"});
  const auto linuxcnc =
      motions("G21 G90 G0 X0 Y0 Z10\nG2 X10. Y0. I5. J0. Z-5. F100.\nM2\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(last_of<ArcFeed>(linuxcnc).feed.value, 100.0);
  // What is written gives the same speed: F of the plane for Fanuc, along the helix for others.
  const auto for_fanuc = write_nc(linuxcnc, Dialect::fanuc, {});
  ASSERT_TRUE(for_fanuc);
  EXPECT_NE(for_fanuc->text.find("F72.32167"), std::string::npos) << for_fanuc->text;
  const auto for_linuxcnc = write_nc(all, Dialect::linuxcnc, {});
  ASSERT_TRUE(for_linuxcnc);
  EXPECT_NE(for_linuxcnc->text.find("F138.27113"), std::string::npos) << for_linuxcnc->text;
}

TEST(FanucParameters, AngleOfASecondRotationReplacesTheFirst) {
  const auto all = after_head("G68 X0 Y0 R30\nG91 G68 X0 Y0 R60\nG90 G1 X10 Y0\n");
  EXPECT_NEAR(*last_of<LinearFeed>(all).end[X], 5.0, 1e-12);
  EXPECT_EQ(assumed_in(all), AssumedNames{"angle of G68"});
  EXPECT_TRUE(assumed_in(after_head("G91 G68 X0 Y0 R60\n")).empty());
}

TEST(FanucParameters, ReferencePointsAndOtherFramesHaveNoPlaceInFrames) {
  for (const char* frame : {"G68 X0 Y0 R30\n", "G51 X0 Y0 Z0 P2.\n", "G51.1 X0\n"}) {
    for (const char* word : {"G27 X0", "G28 Z0", "G29 X0", "G30 Z0", "G52 X1", "G53 G0 Z0", "G54",
                             "G59", "G54.1 P1", "G92 X0"}) {
      EXPECT_EQ(complaint_ids(std::string(kHead) + frame + word + "\n"),
                AssumedNames{"frame-nested"})
          << frame << word;
    }
  }
  for (const char* plane : {"G17", "G18", "G19"}) {
    EXPECT_EQ(complaint_ids(kHead + std::string("G68 X0 Y0 R30\n") + plane + "\n"),
              AssumedNames{"frame-nested"});
  }
  // Beside the word that ends the frame they have.
  for (const char* ends : {"G68 X0 Y0 R30\nG69 G54 G17\n", "G51 X0 Y0 Z0 P2.\nG50 G55\n",
                           "G51.1 X0\nG17\nG50.1 G54\n", "G68 X0 Y0 R0\nG54\n"}) {
    EXPECT_TRUE(complaint_ids(std::string(kHead) + ends).empty()) << ends;
  }
}

// A tool of 10 mm to the left of a square of 40 mm.
AssumedNames of_contour(const std::string& text) {
  InterpreterOptions options;
  options.tools[1].diameter = 10.0;
  return assumed_in(after_head(text, options));
}

TEST(FanucParameters, ContoursTellWhatDependsOnLookAheadAndCorners) {
  const std::string inside = "G41 D1 G1 X0 Y20\nX-20\nZ5\n";
  EXPECT_TRUE(of_contour(inside + "Y0\nG40 X0\n").empty());
  EXPECT_EQ(of_contour(inside + "M8\nY0\nG40 X0\n"), AssumedNames{"look-ahead"});
  EXPECT_EQ(of_contour(inside + "(A)\n(B)\nY0\nG40 X0\n"), AssumedNames{});
  EXPECT_EQ(of_contour("G41 D1 G1 X0 Y20\nY40\nX20\nG40 Y0\n"), AssumedNames{"outside corners"});
  EXPECT_EQ(of_contour("G41 D1 G1 X0 Y20\nX20\nG40 Y0\n"), AssumedNames{"start-up"});
}

}  // namespace
}  // namespace frustum::parser

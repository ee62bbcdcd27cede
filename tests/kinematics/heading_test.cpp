#include "kinematics/heading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustum::kinematics {
namespace {

using std::numbers::pi;
constexpr auto kX = AxisLetter::X;

HeadingTracker tracker_of(AxisLetter axis, double settling) {
  GeometricErrors errors;
  errors[axis].component[0] = ErrorFunction({ReversalTerm{1.0}});
  errors[axis].settling = settling;
  return HeadingTracker(errors);
}

template <typename Course>
AxisMotion along_x(Course course) {
  return [course](double u) {
    AxisPositions q;
    q[kX] = course(u);
    return q;
  };
}

TEST(HeadingTracker, FollowsOnlyAxesWhoseErrorsDependOnTheDirection) {
  HeadingTracker none{GeometricErrors{}};
  EXPECT_FALSE(none.follows_any());
  const auto profile = none.follow(along_x([](double u) { return u; }), 8);
  EXPECT_EQ(profile.at(0.7), AxisPositions{});
  EXPECT_TRUE(profile.turning_points().empty());
  EXPECT_TRUE(tracker_of(kX, 0.0).follows_any());
}

TEST(HeadingTracker, HasNoHeadingBeforeTheFirstMoveAndKeepsItWhileTheAxisStands) {
  HeadingTracker tracker = tracker_of(kX, 0.0);
  const auto dwell = [](double at) { return along_x([at](double) { return at; }); };
  EXPECT_EQ(tracker.follow(dwell(3.0), 8).after(1.0)[kX], 0.0);
  const auto first = tracker.follow(along_x([](double u) { return 3.0 - u; }), 8);
  EXPECT_EQ(first.at(0.0)[kX], 0.0);
  EXPECT_EQ(first.after(0.0)[kX], -1.0);
  EXPECT_EQ(first.at(1.0)[kX], -1.0);
  ASSERT_EQ(first.turning_points().size(), 1u);
  EXPECT_EQ(first.turning_points()[0], 0.0);
  EXPECT_EQ(tracker.follow(dwell(2.0), 8).at(0.5)[kX], -1.0);
  const auto onward = tracker.follow(along_x([](double u) { return 2.0 - u; }), 8);
  EXPECT_TRUE(onward.turning_points().empty());
  EXPECT_EQ(tracker.heading()[kX], -1.0);
}

TEST(HeadingTracker, FindsTurningPointsOfACurvedMotion) {
  for (const int parts : {5, 8, 33}) {
    HeadingTracker tracker = tracker_of(kX, 0.0);
    // Turns at u = 0.15, 0.65; starts in -.
    const auto profile = tracker.follow(
        along_x([](double u) { return 90.0 * std::cos(2 * pi * (u + 0.35)); }), parts);
    const auto turns = profile.turning_points();
    ASSERT_EQ(turns.size(), 3u) << parts;
    EXPECT_EQ(turns[0], 0.0);
    EXPECT_NEAR(turns[1], 0.15, 1e-7);
    EXPECT_NEAR(turns[2], 0.65, 1e-7);
    EXPECT_EQ(profile.at(0.1)[kX], -1.0);
    EXPECT_EQ(profile.at(turns[1])[kX], -1.0);
    EXPECT_EQ(profile.after(turns[1])[kX], 1.0);
    EXPECT_EQ(profile.at(0.4)[kX], 1.0);
    EXPECT_EQ(profile.at(0.9)[kX], -1.0);
  }
}

TEST(HeadingTracker, FindsATurnThatHidesInTheFirstPart) {
  HeadingTracker tracker = tracker_of(kX, 0.0);
  const auto profile =
      tracker.follow(along_x([](double u) { return -50.0 * (u - 0.02) * (u - 0.02); }), 10);
  ASSERT_EQ(profile.turning_points().size(), 2u);
  EXPECT_NEAR(profile.turning_points()[1], 0.02, 1e-7);
}

TEST(HeadingTracker, TurnsWhereAnAxisLeavesItsPlateau) {
  HeadingTracker tracker = tracker_of(kX, 0.0);
  const auto rest = [](double u) { return u < 0.3 ? u : u < 0.7 ? 0.3 : 1.0 - u; };
  const auto profile = tracker.follow(along_x(rest), 50);
  EXPECT_EQ(profile.at(0.6)[kX], 1.0);
  ASSERT_EQ(profile.turning_points().size(), 2u);
  EXPECT_NEAR(profile.turning_points()[1], 0.7, 2e-9);
}

TEST(HeadingTracker, TakesRoundingForNoMotion) {
  HeadingTracker tracker = tracker_of(kX, 0.0);
  const auto noise = [](double u) { return 100.0 + 1e-12 * std::sin(1e4 * u); };
  EXPECT_TRUE(tracker.follow(along_x(noise), 100).turning_points().empty());
  const auto ramp = [](double u) { return 10.0 * u + 1e-12 * std::sin(1e4 * u); };
  EXPECT_EQ(tracker.follow(along_x(ramp), 100).turning_points().size(), 1u);
}

TEST(HeadingTracker, TakesUpThePlayOverTheSettlingDistance) {
  HeadingTracker tracker = tracker_of(kX, 2.0);
  const auto out = tracker.follow(along_x([](double u) { return 10.0 * u; }), 4);
  EXPECT_NEAR(out.at(0.05)[kX], 0.5, 1e-12);  // from the middle of the play
  EXPECT_NEAR(out.at(0.2)[kX], 1.0, 1e-12);
  const auto back = tracker.follow(along_x([](double u) { return 10.0 - 10.0 * u; }), 4);
  EXPECT_NEAR(back.at(0.0)[kX], 1.0, 1e-12);
  EXPECT_NEAR(back.at(0.1)[kX], 0.0, 1e-12);
  EXPECT_NEAR(back.at(0.15)[kX], -0.5, 1e-12);
  EXPECT_EQ(back.at(0.5)[kX], -1.0);
  ASSERT_EQ(back.turning_points().size(), 2u);
  EXPECT_NEAR(back.turning_points()[1], 0.2, 1e-12);
  // A swing shorter than the play leaves it half taken up.
  (void)tracker.follow(along_x([](double u) { return 0.5 * u; }), 4);
  EXPECT_NEAR(tracker.heading()[kX], -0.5, 1e-12);
}

// The play operator by its own definition, marched in small steps.
TEST(HeadingTrackerLaws, AgreeWithAMarchedPlayOperator) {
  const double settling = 0.7;
  const auto course = [](double u) { return std::sin(9.0 * u) + 0.4 * std::sin(23.0 * u + 1.0); };
  HeadingTracker tracker = tracker_of(kX, settling);
  const auto profile = tracker.follow(along_x(course), 200);
  double heading = 0.0, before = course(0.0);
  const int steps = 20000;
  for (int k = 1; k <= steps; ++k) {
    const double u = static_cast<double>(k) / steps, q = course(u);
    heading = std::clamp(heading + 2.0 * (q - before) / settling, -1.0, 1.0);
    before = q;
    // 1e-6: a marched step may turn in its middle.
    ASSERT_NEAR(profile.at(u)[kX], heading, 1e-6) << u;
    AxisPositions known;
    known[kX] = q;
    ASSERT_EQ(profile.at(u, known)[kX], profile.at(u)[kX]);
  }
  EXPECT_NEAR(tracker.heading()[kX], heading, 1e-6);
}

}  // namespace
}  // namespace frustum::kinematics

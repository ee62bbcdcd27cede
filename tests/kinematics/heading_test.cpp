#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/path/approach_direction.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using std::numbers::pi;
constexpr auto kX = AxisLetter::X;

ApproachTracker tracker_of(AxisLetter axis, double lost_motion) {
  GeometricErrors errors;
  errors[axis].component[0] = ErrorFunction({ReversalTerm{1.0}});
  errors[axis].lost_motion = lost_motion;
  return ApproachTracker(errors);
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
  ApproachTracker none{GeometricErrors{}};
  EXPECT_FALSE(none.follows_any());
  const auto profile = none.follow(along_x([](double u) { return u; }), 8);
  EXPECT_EQ(profile.at(0.7), AxisPositions{});
  EXPECT_TRUE(profile.turning_points().empty());
  EXPECT_TRUE(tracker_of(kX, 0.0).follows_any());
}

TEST(HeadingTracker, HasNoHeadingBeforeTheFirstMoveAndKeepsItWhileTheAxisStands) {
  ApproachTracker tracker = tracker_of(kX, 0.0);
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
    ApproachTracker tracker = tracker_of(kX, 0.0);
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
  ApproachTracker tracker = tracker_of(kX, 0.0);
  const auto profile =
      tracker.follow(along_x([](double u) { return -50.0 * (u - 0.02) * (u - 0.02); }), 10);
  ASSERT_EQ(profile.turning_points().size(), 2u);
  EXPECT_NEAR(profile.turning_points()[1], 0.02, 1e-7);
}

TEST(HeadingTracker, TurnsWhereAnAxisLeavesItsPlateau) {
  ApproachTracker tracker = tracker_of(kX, 0.0);
  const auto rest = [](double u) { return u < 0.3 ? u : u < 0.7 ? 0.3 : 1.0 - u; };
  const auto profile = tracker.follow(along_x(rest), 50);
  EXPECT_EQ(profile.at(0.6)[kX], 1.0);
  ASSERT_EQ(profile.turning_points().size(), 2u);
  EXPECT_NEAR(profile.turning_points()[1], 0.7, 2e-9);
}

TEST(HeadingTracker, TakesRoundingForNoMotion) {
  ApproachTracker tracker = tracker_of(kX, 0.0);
  const auto noise = [](double u) { return 100.0 + 1e-12 * std::sin(1e4 * u); };
  EXPECT_TRUE(tracker.follow(along_x(noise), 100).turning_points().empty());
  const auto ramp = [](double u) { return 10.0 * u + 1e-12 * std::sin(1e4 * u); };
  EXPECT_EQ(tracker.follow(along_x(ramp), 100).turning_points().size(), 1u);
}

TEST(HeadingTracker, RoundingOfAProgramsWordsTurnsNoAxisAndACreepDoes) {
  ApproachTracker tracker = tracker_of(kX, 0.0);
  double at = 0.0;
  const auto move_to = [&](double to) {
    const auto profile =
        tracker.follow(along_x([from = at, to](double u) { return from + u * (to - from); }), 1);
    at = to;
    return profile;
  };
  (void)move_to(10.0);
  // A nanometre to and fro is the last digit of a word.
  for (const double to : {9.999999, 10.0, 9.999999, 10.000001, 9.999999}) {
    EXPECT_TRUE(move_to(to).turning_points().empty()) << to;
    EXPECT_EQ(tracker.heading()[kX], 1.0) << to;
  }
  // A nanometre a block, always back, is motion, however short the blocks.
  for (int k = 1; k <= 5; ++k) (void)move_to(10.0 - k * 1e-6);
  EXPECT_EQ(tracker.heading()[kX], -1.0);
  // What turns as a motion begins has left in its new direction.
  EXPECT_EQ(move_to(10.0001).after(0.0)[kX], 1.0);
}

// On a full circle two samples are at one place where parts are odd in number: the axis did not
// stand between them.
TEST(HeadingTracker, TurnsInTheMiddleOfAPartAsAnywhereElse) {
  for (int parts = 2; parts < 100; ++parts) {
    for (const double start : {0.0, 0.25, 1.0 / 3.0}) {
      ApproachTracker tracker = tracker_of(kX, 0.0);
      (void)tracker.follow(along_x([](double u) { return 60.0 - 5.0 * u; }), 4);
      const auto circle = [start](double u) { return 55.0 * std::cos(2.0 * pi * (u + start)); };
      const auto profile = tracker.follow(along_x(circle), parts);
      const double turn = start < 0.5 ? 0.5 - start : 0.0;
      const auto turns = profile.turning_points();
      EXPECT_TRUE(std::ranges::any_of(turns, [&](double u) { return std::abs(u - turn) < 1e-6; }))
          << parts << " parts from " << start;
    }
  }
}

TEST(HeadingTracker, TakesUpThePlayOverTheSettlingDistance) {
  ApproachTracker tracker = tracker_of(kX, 2.0);
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
  const double lost_motion = 0.7;
  const auto course = [](double u) { return std::sin(9.0 * u) + 0.4 * std::sin(23.0 * u + 1.0); };
  ApproachTracker tracker = tracker_of(kX, lost_motion);
  const auto profile = tracker.follow(along_x(course), 200);
  double heading = 0.0, before = course(0.0);
  const int steps = 20000;
  for (int k = 1; k <= steps; ++k) {
    const double u = static_cast<double>(k) / steps, q = course(u);
    heading = std::clamp(heading + 2.0 * (q - before) / lost_motion, -1.0, 1.0);
    before = q;
    // 1e-6: a marched step may turn in its middle.
    ASSERT_NEAR(profile.at(u)[kX], heading, 1e-6) << u;
    AxisPositions known;
    known[kX] = q;
    ASSERT_EQ(profile.at(u, known)[kX], profile.at(u)[kX]);
  }
  EXPECT_NEAR(tracker.heading()[kX], heading, 1e-6);
}

// The inclined cone of the ETH thesis on its table machine (alpha 45, beta 30 deg, r 40 mm, cone
// centre at (-65, 0, 150) mm), evaluated as section 3.9 does: peak to valley of the deviation along
// the normal after its mean, cosine and sine are taken off.
class ConeDeviation {
 public:
  explicit ConeDeviation(const std::vector<std::string>& texts) : machine_(shipped("iwf-bc")) {
    std::vector<ErrorEntry> entries;
    for (const std::string& text : texts) entries.push_back(*parse_error(text));
    errors_ = *resolve(machine_, entries);
  }

  [[nodiscard]] double circularity_um() const {
    constexpr int kSamples = 3600;
    ApproachTracker tracker(errors_);
    const AxisMotion lap = [](double u) { return axes_at(2 * pi * u); };
    (void)tracker.follow(lap, 72);  // the first lap settles the approach_directions
    const ApproachProfile profile = tracker.follow(lap, 72);
    Eigen::Matrix<double, kSamples, 3> shape;
    Eigen::Matrix<double, kSamples, 1> deviation;
    for (int k = 0; k < kSamples; ++k) {
      const double u = (k + 0.5) / kSamples, phi = 2 * pi * u;
      const AxisPositions q = axes_at(phi);
      const Vec3 nominal = nominal_pose(machine_, q, 0.0).translation;
      EXPECT_LT((nominal - (tilted(40 * std::cos(phi), 40 * std::sin(phi), 0) + centre())).norm(),
                1e-9);
      const Vec3 actual = actual_pose(machine_, errors_, {q, profile.at(u, q)}, 0.0).translation;
      const double a = kAlpha;
      const Vec3 normal =
          tilted(std::cos(a) * std::cos(phi), std::cos(a) * std::sin(phi), std::sin(a));
      deviation[k] = (actual - nominal).dot(normal) * kUmPerMm;
      shape.row(k) << 1.0, std::cos(phi), std::sin(phi);
    }
    const Eigen::Vector3d fit =
        (shape.transpose() * shape).inverse() * (shape.transpose() * deviation);
    const auto rest = (deviation - shape * fit).eval();
    return rest.maxCoeff() - rest.minCoeff();
  }

 private:
  static constexpr double kAlpha = pi / 4, kBeta = pi / 6;
  static Vec3 centre() { return {-65.0, 0.0, 150.0}; }
  static Vec3 tilted(double x, double y, double z) { return rotation_y(kBeta) * Vec3(x, y, z); }
  static AxisPositions axes_at(double phi) {
    const double ca = std::cos(kAlpha), sa = std::sin(kAlpha), cb = std::cos(kBeta),
                 sb = std::sin(kBeta);
    AxisPositions q;
    const double b = -std::acos(ca * cb + sa * sb * std::cos(phi));
    double c = std::atan2(sa * std::sin(phi), sa * cb * std::cos(phi) - sb * ca);
    if (c < 0.0) c += 2 * pi;
    if (phi > 6.0 && c < 1.0) c += 2 * pi;
    const Vec3 xyz =
        rotation_y(-b) *
        (rotation_z(-c) * (tilted(40 * std::cos(phi), 40 * std::sin(phi), 0) + centre()));
    q[AxisLetter::X] = xyz.x();
    q[AxisLetter::Y] = xyz.y();
    q[AxisLetter::Z] = xyz.z();
    q[AxisLetter::B] = b;
    q[AxisLetter::C] = c;
    return q;
  }

  Machine machine_;
  GeometricErrors errors_;
};

// Table 3.4: 9.9 and 10.0 printed for X and Y; the values of an independent computation with full
// jumps.
TEST(HeadingReference, HysteresisRowsOfThesisTable3_4) {
  EXPECT_NEAR(ConeDeviation({"EXX=reversal 10um"}).circularity_um(), 9.991, 0.01);
  EXPECT_NEAR(ConeDeviation({"EYY=reversal 10um"}).circularity_um(), 10.060, 0.01);
  EXPECT_NEAR(ConeDeviation({"EBB=reversal 50urad"}).circularity_um(), 6.670, 0.01);
  EXPECT_NEAR(ConeDeviation({"ECC=reversal 50urad"}).circularity_um(), 0.0, 0.002);
}

}  // namespace
}  // namespace frustum::kinematics

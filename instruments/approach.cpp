#include "instruments/approach.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustum::instruments {
namespace {

using kinematics::AxisPositions;

// Looked at every half degree: axes of a cone path turn back at most a few times a turn.
constexpr double kPart = 0.5 * kRadPerDeg;

AxisPositions between(const AxisPositions& a, const AxisPositions& b, double u) {
  AxisPositions q;
  for (const auto letter : kinematics::kAxisLetters) {
    q[letter] = a[letter] + u * (b[letter] - a[letter]);
  }
  return q;
}

}  // namespace

std::vector<TestPose> with_approach(std::vector<TestPose> poses, const AxisPositions& start,
                                    const kinematics::GeometricErrors& errors) {
  kinematics::ApproachTracker tracker(errors);
  if (!tracker.follows_any()) return poses;
  AxisPositions from = start;
  for (TestPose& pose : poses) {
    const AxisPositions to = pose.at.q;
    (void)tracker.follow([from, to](double u) { return between(from, to, u); }, 1);
    pose.at.heading = tracker.heading();
    from = to;
  }
  return poses;
}

MotionTest with_approach(MotionTest test, const kinematics::GeometricErrors& errors) {
  if (test.poses.empty()) return test;
  if (!test.motion.axes) {
    const AxisPositions start = test.poses.front().at.q;
    test.poses = with_approach(std::move(test.poses), start, errors);
    return test;
  }
  kinematics::ApproachTracker tracker(errors);
  if (!tracker.follows_any()) return test;
  const TestMotion& motion = test.motion;
  const double length = motion.to - motion.from;
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(length) / kPart)));
  const auto profile = tracker.follow(
      [&motion, length](double u) { return motion.axes(motion.from + u * length); }, parts);
  for (TestPose& pose : test.poses) {
    pose.at.heading = profile.at((pose.parameter - motion.from) / length, pose.at.q);
  }
  return test;
}

}  // namespace frustum::instruments

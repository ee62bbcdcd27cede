// Rays that once were answered wrongly, or never: found by proofs of surface points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cutter/search/swept_cutter.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::SweptCutter;

SweptCutter sweep_of_kind(const std::string& kind, kinematics::ToolPath path) {
  return *SweptCutter::sweep(std::move(path), {{1, kind_named(kind).cutter}});
}

double distance(const std::string& kind, const kinematics::ToolPose& pose, const Vec3& point) {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  return kind_named(kind).cutter.body().generatrix().distance((m - z * pose.axis).norm(), z);
}

TEST(AwkwardChords, LeaveThroughTheTopAboveAnArc) {
  // Upwards through the barrel's top face, which moves in its own plane: it is that face that is
  // touched.
  const Ray up{Vec3(3.0, 0.5, 15.0), Vec3(-0.1, 0.05, 1.0).normalized()};
  const auto chord = kind_named("barrel").cutter.body().parts()[0].chord({}, up);
  ASSERT_TRUE(chord);
  EXPECT_EQ(chord->hi_face, cutter::kTopFace);
  const auto swept = sweep_of_kind(
      "barrel", path_through({{Vec3(-2, 0, 0), Vec3::UnitZ()}, {Vec3(2, 0, 0), Vec3::UnitZ()}}));
  const IntervalSet covered = swept.along(up, {-50.0, 50.0});
  ASSERT_EQ(covered.intervals().size(), 1U);
  EXPECT_NEAR(up.at(covered.intervals()[0].hi).z(), 20.0, 1e-9);
}

TEST(AwkwardChords, EndOnAHollowedArcToTheLastBit) {
  Draw draw(19, 31);
  const auto path = random_path(MotionFamily::dwell, draw);
  const auto swept = sweep_of_kind("waisted", path);
  for (int k = 0; k < 400; ++k) {
    const Ray ray{draw.point(Vec3(-20, -20, -20), Vec3(20, 20, 20)), draw.direction()};
    const IntervalSet covered = swept.along(ray, {-100.0, 100.0});
    for (const Interval& i : covered.intervals()) {
      EXPECT_NEAR(distance("waisted", path.poses[0], ray.at(i.lo)), 0.0, 1e-7) << k;
      EXPECT_NEAR(distance("waisted", path.poses[0], ray.at(i.hi)), 0.0, 1e-7) << k;
    }
  }
}

// How far a place is inside a body of cones at a pose: by both height and radius.
double depth_in(const cutter::Profile& body, const kinematics::ToolPose& pose, const Vec3& place) {
  const Vec3 m = place - pose.tip;
  const double z = m.dot(pose.axis), rho = (m - z * pose.axis).norm();
  double depth = std::min(z - body.bottom(), body.height() - z);
  for (const cutter::Zone& zone : body.zones())
    depth = std::min(depth, zone.radius + zone.slope * (z - zone.z_lo) - rho);
  return depth;
}

TEST(AwkwardChords, OfRaysAlongAFlankOrNearlySo) {
  using cutter::cone_zone;
  const cutter::Profile bodies[] = {
      cutter::Profile({cone_zone(0.0, 5.0, 0.0, 5.0), cone_zone(5.0, 5.0, 5.0, 40.0)}),
      cutter::Profile({cone_zone(3.0, 8.0, 0.0, 28.356)}),
      cutter::Profile({cone_zone(6.0, 1.0, 0.0, 20.0)})};
  constexpr double kRounding = 1e-6;  // mm
  Draw draw(7, 91);
  for (const cutter::Profile& body : bodies) {
    const cutter::Zone& flank = body.zones().front();
    for (int k = 0; k < 300; ++k) {
      const Vec3 axis = draw.direction(), side = perpendicular_to(axis);
      const kinematics::ToolPose pose{draw.point(Vec3(-9, -9, -9), Vec3(9, 9, 9)), axis};
      const double turned = k % 2 == 0 ? 0.0 : draw.decades(1e-17, 1e-3);
      const Vec3 along = (axis + flank.slope * side + turned * axis.cross(side)).normalized();
      // In the plane of the flank and the axis, or beside it.
      const double beside = k % 5 < 3 ? 0.0 : draw.between(-4.0, 4.0);
      const double outwards = k % 5 == 4 ? 0.0 : draw.between(-20.0, 20.0);
      const Vec3 place = pose.tip + (flank.radius + outwards) * side + beside * axis.cross(side);
      const Ray ray{place, k % 3 == 0 ? along : Vec3(-along)};
      const auto chord = body.chord(pose, ray);
      for (double s = -60.0; s <= 60.0; s += 0.1) {
        const bool inside = chord && s > chord->lo && s < chord->hi;
        const double depth = depth_in(body, pose, ray.at(s));
        if (std::abs(depth) < kRounding) continue;
        ASSERT_EQ(inside, depth > 0.0) << k << " at " << s;
      }
    }
  }
}

TEST(AwkwardChords, OfRaysNearlyAlongTheAxisEndOnTheBody) {
  // The nearest place to the axis may be metres away.
  const cutter::Profile chamfer(
      {cutter::cone_zone(1.08, 4.48, 0.0, 0.0958), cutter::cone_zone(4.48, 4.48, 0.0958, 75.5)});
  const cutter::Profile drill(
      {cutter::cone_zone(0.0, 3.0, 0.0, 1.8), cutter::cone_zone(3.0, 3.0, 1.8, 400.0)});
  Draw draw(8, 91);
  for (const cutter::Profile* body : {&chamfer, &drill}) {
    const double radius = body->max_radius();
    for (int k = 0; k < 3000; ++k) {
      const Vec3 axis = draw.direction(), side = perpendicular_to(axis);
      const kinematics::ToolPose pose{draw.point(Vec3(-9, -9, -9), Vec3(9, 9, 9)), axis};
      // By the rim, or by the tip.
      const double beside = k % 3 == 0 ? 0.0 : radius * (1.0 - draw.decades(1e-6, 0.5));
      const Vec3 place = pose.tip + beside * side;
      const double lean = k % 2 == 0 ? 0.0 : draw.decades(1e-9, 0.2);
      const Ray ray{place - 60.0 * axis, (axis + lean * axis.cross(side)).normalized()};
      const auto chord = body->chord(pose, ray);
      if (!chord) continue;
      EXPECT_NEAR(depth_in(*body, pose, ray.at(chord->lo)), 0.0, 1e-12) << k << ' ' << lean;
      EXPECT_NEAR(depth_in(*body, pose, ray.at(chord->hi)), 0.0, 1e-12) << k << ' ' << lean;
    }
  }
}

TEST(AwkwardChords, PartWhileTheCutterTurns) {
  // The ray runs along the top of a cutter that turns: its chord slides from one side to the other
  // and is gone in between.
  for (const char* kind : {"barrel", "taper"}) {
    Draw draw(2, 31);
    const auto path = random_path(MotionFamily::crossing, draw);
    Ray ray;
    for (int k = 0; k <= 3; ++k) {
      ray = {draw.point(Vec3(-20, -20, -20), Vec3(20, 20, 20)), draw.direction()};
    }
    const auto swept = sweep_of_kind(kind, path);
    const IntervalSet covered = swept.along(ray, {-100.0, 100.0});
    for (const auto& segment : path.segments) {
      for (int i = 0; i <= 1000; ++i) {
        const auto pose = kinematics::between(path.from(segment), path.to(segment), i / 1000.0);
        const auto chord = kind_named(kind).cutter.body().parts()[0].chord(pose, ray);
        if (!chord || chord->hi - chord->lo < 1e-5) continue;
        EXPECT_TRUE(covered.covers(chord->lo + 1e-6, chord->hi - 1e-6)) << kind << ' ' << i;
      }
    }
  }
}

TEST(AwkwardChords, GoOnWhereThePartsOfACutterMeet) {
  Draw draw(26, 31);
  const auto swept = sweep_of_kind("measured", random_path(MotionFamily::straight, draw));
  for (int k = 0; k < 100; ++k) {
    const Ray ray{draw.point(Vec3(-20, -20, -20), Vec3(20, 20, 20)), draw.direction()};
    const IntervalSet covered = swept.along(ray, {-100.0, 100.0});
    for (std::size_t i = 1; i < covered.intervals().size(); ++i) {
      EXPECT_GT(covered.intervals()[i].lo - covered.intervals()[i - 1].hi, 1e-9);
    }
  }
}

TEST(AwkwardChords, KnowTheNormalThatARimLeaves) {
  // A flat end leans by 5 degrees against its feed: the rim at the heel cuts the floor, whose
  // normal is up.
  const double lean = 5.0 * kRadPerDeg;
  const Vec3 axis(std::sin(lean), 0.0, std::cos(lean));
  const auto swept =
      sweep_of_kind("flat", path_through({{Vec3(-20, 0, 0), axis}, {Vec3(20, 0, 0), axis}}));
  const auto floor = swept.end_of_void({Vec3(0, 0, 3), -Vec3::UnitZ()}, 0.0, 10.0);
  ASSERT_TRUE(floor);
  EXPECT_NEAR((floor->normal + Vec3::UnitZ()).norm(), 0.0, 1e-9);
  // Beside the middle the trough is an ellipse.
  const auto side = swept.end_of_void({Vec3(0, 4.0, 3), -Vec3::UnitZ()}, 0.0, 10.0);
  ASSERT_TRUE(side);
  const double rise = std::sin(lean) * 4.0 / std::sqrt(36.0 - 16.0);
  EXPECT_NEAR((side->normal - Vec3(0, rise, -1).normalized()).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace frustum::proof

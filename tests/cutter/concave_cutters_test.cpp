// Concave cutters: narrow rings that run-out leaves, rims, lands that are in the ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutter/search/swept_cutter.hpp"
#include "cutter/sweep/concave_sweep.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::Body;
using cutter::Cutter;
using cutter::CutterSpec;
using cutter::CutterType;
using cutter::SegmentMotion;
using cutter::SweptCutter;
using kinematics::ToolPath;
using kinematics::ToolPose;

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

Cutter twist_drill(double tip_angle, double run_out) {
  return *Cutter::make({.type = CutterType::drill,
                        .diameter = {6.0},
                        .length = {80.0},
                        .flute_length = {28.0},
                        .tip_angle = {tip_angle},
                        .run_out = {run_out}});
}
Cutter hollow_end(double angle) {
  return *Cutter::make({.type = CutterType::flat,
                        .diameter = {12.0},
                        .length = {80.0},
                        .flute_length = {30.0},
                        .end_angle = {angle}});
}
Cutter coved() {
  return *Cutter::make({.type = CutterType::profile,
                        .length = {60.0},
                        .rows = {{0, 1, 0}, {3, 0, -6}, {4, 0, 0}, {4.5, 3, -2}, {7, 8, -5}}});
}

// The least signed distance over the segment: moments a quarter of a micrometre apart near the
// least.
double least_distance(const Body& body, const SegmentMotion& motion, const Vec3& point) {
  double least = 1e9;
  const auto look = [&](double t) {
    const double d = body.distance(motion.at(t), point);
    least = std::min(least, d);
    return d;
  };
  const double way = 2.5e-4 / motion.travel();
  for (double t = 0.0; t <= 1.0;) {
    const double d = look(t);
    t += std::max(way, (d - least) / motion.travel());
  }
  // Around each of the lowest: closer and closer.
  const double floor = least + 2.5e-4;
  for (double t = 0.0; t <= 1.0;) {
    const double d = body.distance(motion.at(t), point);
    if (d <= floor) {
      double lo = std::max(0.0, t - way), hi = std::min(1.0, t + way);
      for (int k = 0; k < 60; ++k) {
        const double a = lo + 0.382 * (hi - lo), b = lo + 0.618 * (hi - lo);
        if (look(a) < look(b)) {
          hi = b;
        } else {
          lo = a;
        }
      }
    }
    t += std::max(way, (d - floor) / motion.travel());
  }
  return least;
}

ToolPath short_stroke(Draw& draw) {
  const ToolPose from{Vec3::Zero(), draw.axis(0.3)};
  ToolPose to = from;
  to.tip += draw.decades(0.3, 5.0) *
            (from.axis.cross(draw.direction()).normalized() + draw.between(-1.0, 1.0) * from.axis);
  if (draw.chance(0.5)) to.axis = (to.axis + 0.1 * draw.direction()).normalized();
  return path_through({from, to});
}

// Where the run-out ring of a point goes by, two moments near each other may touch one place.
TEST(HollowCutterLaws, EndsOfNarrowRingsLieOnTheSweep) {
  for (const double run_out : {0.05, 0.02, 0.006}) {
    for (const double angle : {60.0, 118.0}) {
      const Cutter tool = twist_drill(angle * kRadPerDegree, run_out);
      int ends = 0;
      for (std::uint32_t p = 0; p < 25; ++p) {
        Draw draw(41, p);
        const ToolPath path = short_stroke(draw);
        const auto swept = SweptCutter::sweep(path, {{1, tool}});
        ASSERT_TRUE(swept);
        EXPECT_LT(swept->accuracy(), 2e-5);
        const SegmentMotion motion(path, path.segments[0], tool.body().reach());
        const ToolPose at = motion.at(draw.between(0.0, 1.0));
        const Vec3 side = at.axis.cross(draw.direction()).normalized();
        const Vec3 near = at.tip + draw.between(0.0, 2.0 * run_out) * side;
        const Vec3 direction = draw.chance(0.5) ? Vec3(-at.axis) : draw.direction();
        const Ray ray{near - 40.0 * direction, direction};
        const IntervalSet covered = swept->along(ray, {0.0, 80.0});
        for (const Interval& i : covered.intervals()) {
          for (const double s : {i.lo, i.hi}) {
            if (s <= 0.0 || s >= 80.0) continue;
            ++ends;
            EXPECT_NEAR(least_distance(tool.body(), motion, ray.at(s)), 0.0, 1e-6)
                << "run-out " << run_out << " angle " << angle << " path " << p;
          }
        }
      }
      EXPECT_GT(ends, 30);
    }
  }
}

// What touches the surface at a moment between the ends of a motion moves along it there.
TEST(HollowCutterLaws, NormalsAreSquareToTheMotion) {
  int contacts = 0;
  for (const Cutter& tool :
       {hollow_end(0.5 * kRadPerDegree), hollow_end(5.0 * kRadPerDegree), coved()}) {
    for (std::uint32_t p = 0; p < 20; ++p) {
      Draw draw(42, p);
      const ToolPath path = random_path(MotionFamily::five_axis, draw);
      const auto swept = SweptCutter::sweep(path, {{1, tool}});
      ASSERT_TRUE(swept);
      const SegmentMotion motion(path, path.segments[0], tool.body().reach());
      for (int k = 0; k < 10; ++k) {
        const ToolPose at = motion.at(draw.between(0.0, 1.0));
        const Vec3 side = at.axis.cross(draw.direction()).normalized();
        const Vec3 inside = at.tip + draw.between(0.0, tool.body().max_radius()) * side +
                            draw.between(0.0, 0.2) * at.axis;
        const Vec3 direction = (0.7 * draw.direction() - at.axis).normalized();
        const Ray ray{inside - 60.0 * direction, direction};
        const IntervalSet covered = swept->along(ray, {0.0, 120.0});
        for (const Interval& i : covered.intervals()) {
          const auto contact = swept->contact(ray, i.hi, 0);
          if (i.hi >= 120.0 || contact.t < 1e-4 || contact.t > 1.0 - 1e-4) continue;
          ++contacts;
          const Vec3 moving = motion.velocity(ray.at(i.hi), contact.t).normalized();
          EXPECT_NEAR(contact.normal.dot(moving), 0.0, 1e-3) << "path " << p << " ray " << k;
          EXPECT_GT(contact.normal.dot(direction), -1e-6) << "path " << p << " ray " << k;
        }
      }
    }
  }
  EXPECT_GT(contacts, 200);
}

// A land of the end that is in the ray: on the surface, so not covered, and not in a thousand
// pieces.
TEST(HollowCutterLaws, LevelLandsAreNotCoveredByRounding) {
  const Cutter tool = *Cutter::make({.type = CutterType::bull,
                                     .diameter = {12.0},
                                     .length = {80.0},
                                     .flute_length = {30.0},
                                     .corner_radius = {0.8},
                                     .end_angle = {2.0 * kRadPerDegree},
                                     .run_out = {0.5}});
  const ToolPose at{Vec3(0.123, 0.456, 0.0), Vec3(0.1, 0.2, 1.0).normalized()};
  const auto swept = SweptCutter::sweep(path_through({at, at}), {{1, tool}});
  ASSERT_TRUE(swept);
  const Vec3 along = at.axis.cross(Vec3(0.6, 0.8, 0.1)).normalized();
  const Ray ray{at.tip + 0.3 * at.axis.cross(along) - 50.0 * along, along};
  EXPECT_TRUE(swept->along(ray, {0.0, 100.0}).empty());
}

Cutter with_level_land() {
  return *Cutter::make({.type = CutterType::bull,
                        .diameter = {12.0},
                        .length = {80.0},
                        .flute_length = {30.0},
                        .corner_radius = {0.8},
                        .end_angle = {2.0 * kRadPerDegree},
                        .run_out = {0.5}});
}

// The land slides along the ray for 50 mm: by steps as long as it is away from the ray, each of
// which asks all moments, that were some 10^9 looks and half a minute.
TEST(HollowCutterLaws, LongLevelSegmentsLeaveARayInTheEndPlaneAlone) {
  const Cutter tool = with_level_land();
  const Vec3 axis = Vec3(0.1, 0.2, 1.0).normalized();
  const Vec3 feed = axis.cross(Vec3(0.3, 0.7, 0.05)).normalized();
  const Vec3 tip(0.123, 0.456, 0.789);
  const SegmentMotion motion({tip, axis}, {tip + 50.0 * feed, axis}, tool.body().reach());
  for (const double share : {0.0, 0.37, 1.0}) {
    for (const double beside : {0.3, 5.0}) {
      const Vec3 along = axis.cross(Vec3(0.6, 0.8, 0.1)).normalized();
      const Ray ray{tip + share * 50.0 * feed + beside * axis.cross(along) - 50.0 * along, along};
      const cutter::ConcaveSweep sweep(tool.body(), motion, ray);
      cutter::FewSegmentIntervals found;
      sweep.walk(0.0, 100.0, found);
      EXPECT_TRUE(found.empty()) << share << ' ' << beside;
      EXPECT_LT(sweep.looks(), 200'000U) << share << ' ' << beside;
    }
  }
}

// A ray that a tilting tool covers by a few micrometres, all along: what one pose covers is passed
// over at once.
TEST(HollowCutterLaws, ShallowCutsAlongARayAreWalkedInFewSteps) {
  const Cutter tool = with_level_land();
  const Vec3 axis = Vec3(0.1, 0.2, 1.0).normalized();
  const Vec3 turned = (axis + 0.02 * Vec3(0.4, -0.3, 0.1)).normalized();
  const Vec3 to = Vec3(0.7, -0.3, 0.05) - Vec3(0.7, -0.3, 0.05).dot(axis) * axis;
  const Vec3 tip(0.123, 0.456, 0.789);
  const ToolPath path = path_through({{tip, axis}, {tip + 50.0 * to.normalized(), turned}});
  const SegmentMotion motion(path, path.segments[0], tool.body().reach());
  const Vec3 along = axis.cross(Vec3(0.6, 0.8, 0.1)).normalized();
  const Ray ray{tip + 5.0 * axis.cross(along) - 50.0 * along, along};
  const cutter::ConcaveSweep sweep(tool.body(), motion, ray);
  cutter::FewSegmentIntervals found;
  sweep.walk(46.5, 50.0, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].lo.s, 46.5);
  EXPECT_EQ(found[0].hi.s, 50.0);
  EXPECT_LT(sweep.looks(), 2'000'000U);
}

// A ray in the end plane at one moment, and next to it by what the tool turns at all others:
// stretches of it are left aside, or covered by moments that follow it, each in a few steps.
TEST(HollowCutterLaws, ToolsThatTurnLeaveARayInTheEndPlaneInFewLooks) {
  const Vec3 axis = Vec3(0.1, 0.2, 1.0).normalized(), tip(0.123, 0.456, 0.789);
  const Vec3 feed = axis.cross(Vec3(0.3, 0.7, 0.05)).normalized();
  std::size_t most = 0;
  for (const Cutter& tool : {with_level_land(),
                             *Cutter::make({.type = CutterType::bull,
                             .diameter = {12.0},
                             .length = {80.0},
                             .flute_length = {30.0},
                             .corner_radius = {0.8},
                             .end_angle = {2.0 * kRadPerDegree}}),
                             hollow_end(0.5 * kRadPerDegree)}) {
    for (const double turn : {1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.04, 0.2, 1.0}) {
      for (const double run : {0.0, 3.0, 50.0}) {
        for (const Vec3& towards : {feed, Vec3(axis.cross(feed))}) {
          const Vec3 turned = std::cos(turn) * axis + std::sin(turn) * towards;
          const SegmentMotion motion({tip, axis}, {tip + run * feed, turned.normalized()},
                                     tool.body().reach());
          for (const double share : {0.0, 0.37, 1.0}) {
            const ToolPose at = motion.at(share);
            const Vec3 along = at.axis.cross(Vec3(0.6, 0.8, 0.1)).normalized();
            const Ray ray{at.tip + 5.0 * at.axis.cross(along) - 50.0 * along, along};
            const cutter::ConcaveSweep sweep(tool.body(), motion, ray);
            cutter::FewSegmentIntervals found;
            sweep.walk(0.0, 120.0, found);
            most = std::max(most, sweep.looks());
            for (const cutter::SegmentInterval& i : found) {
              for (const cutter::SweptEnd& end : {i.lo, i.hi}) {
                const double away = tool.body().distance(motion.at(end.t), ray.at(end.s));
                EXPECT_NEAR(away, 0.0, 1e-6) << turn << ' ' << run << ' ' << share;
              }
            }
          }
        }
      }
    }
  }
  EXPECT_LT(most, 800'000U);
}

}  // namespace
}  // namespace frustum::proof

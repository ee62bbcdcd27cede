// What a probe that comes out of the void meets is where the whole cover ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cutter/search/swept_cutter.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::SweptCutter;
using kinematics::ToolPath;
using kinematics::ToolPose;

const Vec3 kLow(-40, -40, -30), kHigh(40, 40, 30);

// Strokes here and there, so that the front is led on by many of them, and meets some from behind.
ToolPath scattered_strokes(Draw& draw, int strokes) {
  std::vector<ToolPose> poses;
  for (int i = 0; i < strokes; ++i) {
    const ToolPose from{draw.point(kLow, kHigh), draw.axis(0.6)};
    poses.push_back(from);
    poses.push_back({from.tip + draw.between(0.0, 12.0) * draw.direction(), draw.axis(0.6)});
  }
  ToolPath path = path_through(poses);
  std::erase_if(path.segments,
                [](const kinematics::PathSegment& s) { return s.first_pose % 2 == 1; });
  return path;
}

ToolPath one_long_way(Draw& draw, int poses) {
  std::vector<ToolPose> all;
  for (int i = 0; i < poses; ++i) all.push_back({draw.point(kLow, kHigh), draw.axis(0.6)});
  return path_through(all);
}

// Of `rays` through each of `paths` paths, more than `least` of which begin in the void.
void expect_void_ends_with_the_cover(const cutter::Cutter& tool, std::uint32_t paths, int rays,
                                     double same, int least) {
  constexpr double kLong = 300.0;  // mm
  int led_on = 0;
  for (std::uint32_t p = 0; p < paths; ++p) {
    Draw draw(77, p);
    const ToolPath path = p % 2 == 0 ? scattered_strokes(draw, 20 + 30 * static_cast<int>(p))
                                     : one_long_way(draw, 20 + 10 * static_cast<int>(p));
    const auto swept = SweptCutter::sweep(path, {{1, tool}});
    ASSERT_TRUE(swept);
    for (int k = 0; k < rays; ++k) {
      const Ray ray{draw.point(kLow, kHigh), draw.direction()};
      const IntervalSet cover = swept->along(ray, {0.0, kLong});
      const bool starts_inside = !cover.intervals().empty() && cover.intervals().front().lo <= 1e-9;
      const auto end = swept->end_of_void(ray, 0.0, kLong);
      ASSERT_EQ(end.has_value(), starts_inside) << p << ' ' << k;
      if (!end) continue;
      ++led_on;
      ASSERT_NEAR(std::min(end->s, kLong), cover.intervals().front().hi, same) << p << ' ' << k;
    }
  }
  EXPECT_GT(led_on, least);
}

class VoidEndLaws : public testing::TestWithParam<const char*> {};

TEST_P(VoidEndLaws, TheVoidEndsWhereTheWholeCoverDoes) {
  constexpr double kSame = 1e-6;  // mm
  expect_void_ends_with_the_cover(kind_named(GetParam()).cutter, 12, 100, kSame, 300);
}

class ConcaveVoidEndLaws : public testing::TestWithParam<const char*> {};

TEST_P(ConcaveVoidEndLaws, TheVoidEndsWhereTheWholeCoverDoes) {
  constexpr double kSame = 1e-4;  // mm: a ray that grazes, of 10 nm normal to the surface
  expect_void_ends_with_the_cover(kind_named(GetParam()).cutter, 8, 60, kSame, 60);
}

// Level rays beside an upright cutter that goes straight, from anywhere in what it cuts.
TEST_P(ConcaveVoidEndLaws, LevelRaysAlongAStrokeEndWhereTheCoverDoes) {
  constexpr double kSame = 1e-6, kStroke = 24.0;  // mm
  const cutter::Cutter& tool = kind_named(GetParam()).cutter;
  int led_on = 0;
  for (const double turn : {0.0, 0.4}) {
    const Vec3 feed(std::cos(turn), std::sin(turn), 0.0), beside(-feed.y(), feed.x(), 0.0);
    const auto swept = SweptCutter::sweep(path_through({{-0.5 * kStroke * feed, Vec3::UnitZ()},
                                                        {0.5 * kStroke * feed, Vec3::UnitZ()}}),
                                          {{1, tool}});
    ASSERT_TRUE(swept);
    for (const double share : {0.05, 0.3, 0.6, 0.8, 0.9, 0.95}) {
      for (const double height : {0.02, 0.1, 0.5, 2.0}) {
        const Vec3 at = share * tool.body().max_radius() * beside + height * Vec3::UnitZ();
        for (const Ray& ray : {Ray{at - 40.0 * feed, feed}, Ray{at - 40.0 * beside, beside},
                               Ray{at - 40.0 * Vec3::UnitX(), Vec3::UnitX()}}) {
          const IntervalSet cover = swept->along(ray, {0.0, 80.0});
          for (const Interval& cut : cover.intervals()) {
            for (int k = 0; k < 20; ++k, ++led_on) {
              const double from = cut.lo + (cut.hi - cut.lo) * (k + 0.5) / 20.0;
              const auto end = swept->end_of_void(ray, from, 80.0);
              ASSERT_TRUE(end) << share << ' ' << height << ' ' << k;
              ASSERT_NEAR(end->s, cut.hi, kSame) << share << ' ' << height << ' ' << k;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(led_on, 1000);
}

// A hollow end that comes down a ramp: the rim that trails cuts deepest, and a probe from above
// meets what that left, not what the part above the hollow did.
TEST(ConcaveVoidEnd, IsWhatTheTrailingRimOfAHollowEndLeaves) {
  constexpr double kRadius = 10.0, kSame = 1e-8;  // mm
  const Vec3 from(-45.0, -4.0, 16.0), to(45.0, 5.0, 10.0);
  const ToolPath path = path_through({{from, Vec3::UnitZ()}, {to, Vec3::UnitZ()}});
  const Vec3 at(7.765127, 0.1836998, 40.0);
  // When the rim is there last: |at - tip| across = kRadius.
  const Vec3 step = to - from, off = at - from;
  const double a = step.head<2>().squaredNorm(), b = step.head<2>().dot(off.head<2>());
  const double c = off.head<2>().squaredNorm() - kRadius * kRadius;
  const double t = (b + std::sqrt(b * b - a * c)) / a;
  for (const double end_angle : {5.0, 1.7, 0.5}) {
    const auto tool = cutter::Cutter::make({.type = cutter::CutterType::flat,
                                            .diameter = {2.0 * kRadius},
                                            .length = {60.0},
                                            .end_angle = {end_angle * kRadPerDeg}});
    ASSERT_TRUE(tool);
    const auto swept = SweptCutter::sweep(path, {{1, *tool}});
    ASSERT_TRUE(swept);
    const auto end = swept->end_of_void({at, -Vec3::UnitZ()}, 0.0, 40.0);
    ASSERT_TRUE(end);
    EXPECT_NEAR(at.z() - end->s, from.z() + t * step.z(), kSame) << end_angle;
    EXPECT_NEAR(end->t, t, 1e-6) << end_angle;
  }
}

// A waist that comes down here and there along the ray, each place a little into the next: what
// only the waist covers leads the front on from one to the next, whichever was looked at first.
TEST(ConcaveVoidEnd, IsAtTheLastOfPlacesThatOnlyAWaistJoins) {
  constexpr std::uint32_t kPlaces = 12;
  constexpr double kApart = 6.78, kUp = -4.8, kDown = -5.2;  // mm; the arc is from 4 to 6 high
  const double radius = 5.0 - std::sqrt(4.0 - (6.0 + kUp) * (6.0 + kUp));
  ASSERT_GT(2.0 * radius, kApart);
  for (const std::uint32_t step : {1U, 5U, 7U, 11U}) {
    SCOPED_TRACE(step);
    std::vector<ToolPose> poses;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
      const double x = kApart * ((i * step) % kPlaces);
      poses.push_back({Vec3(x, 0.0, kUp), Vec3::UnitZ()});
      poses.push_back({Vec3(x, 0.0, kDown), Vec3::UnitZ()});
    }
    ToolPath path = path_through(poses);
    std::erase_if(path.segments,
                  [](const kinematics::PathSegment& s) { return s.first_pose % 2 == 1; });
    const auto swept = SweptCutter::sweep(path, {{1, kind_named("waisted").cutter}});
    ASSERT_TRUE(swept);
    for (const double from : {0.0, 2.5, 30.0}) {
      const Ray ray{Vec3(from, 0.0, 0.0), Vec3::UnitX()};
      const auto end = swept->end_of_void(ray, 0.0, 200.0);
      ASSERT_TRUE(end);
      EXPECT_NEAR(from + end->s, kApart * (kPlaces - 1) + radius, 1e-6) << from;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, VoidEndLaws, testing::Values("ball", "flat", "barrel", "taper"),
                         [](const auto& each) { return std::string(each.param); });
INSTANTIATE_TEST_SUITE_P(Kinds, ConcaveVoidEndLaws,
                         testing::Values("hollow", "waisted", "measured"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace frustum::proof

// What a probe that comes out of the void meets is where the whole cover ends.
#include <gtest/gtest.h>

#include <algorithm>

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

class VoidEndLaws : public testing::TestWithParam<const char*> {};

TEST_P(VoidEndLaws, TheVoidEndsWhereTheWholeCoverDoes) {
  constexpr double kLong = 300.0, kSame = 1e-6;  // mm
  int led_on = 0;
  for (std::uint32_t p = 0; p < 12; ++p) {
    Draw draw(77, p);
    const ToolPath path = p % 2 == 0 ? scattered_strokes(draw, 20 + 30 * static_cast<int>(p))
                                     : one_long_way(draw, 20 + 10 * static_cast<int>(p));
    const auto swept = SweptCutter::sweep(path, {{1, kind_named(GetParam()).cutter}});
    ASSERT_TRUE(swept);
    for (int k = 0; k < 100; ++k) {
      const Ray ray{draw.point(kLow, kHigh), draw.direction()};
      const IntervalSet cover = swept->along(ray, {0.0, kLong});
      const bool starts_inside = !cover.intervals().empty() && cover.intervals().front().lo <= 1e-9;
      const auto end = swept->end_of_void(ray, 0.0, kLong);
      ASSERT_EQ(end.has_value(), starts_inside) << p << ' ' << k;
      if (!end) continue;
      ++led_on;
      ASSERT_NEAR(std::min(end->s, kLong), cover.intervals().front().hi, kSame) << p << ' ' << k;
    }
  }
  EXPECT_GT(led_on, 300);
}

INSTANTIATE_TEST_SUITE_P(Kinds, VoidEndLaws, testing::Values("ball", "flat", "barrel", "taper"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace frustum::proof

#include "cutter/search/contact_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum::cutter {
namespace {

// A flat cutter of radius 10 along X over several segments of one block.
SweptCutter pass(const std::vector<ToolPose>& poses) {
  kinematics::ToolPath path;
  path.poses = poses;
  path.blocks = {{.source_line = 1, .tool = 1}};
  for (std::uint32_t i = 0; i + 1 < poses.size(); ++i) path.segments.push_back({i, 0});
  const auto tool = Cutter::make(
      {.type = CutterType::flat, .diameter = {20.0}, .length = {100.0}, .flute_length = {40.0}});
  auto swept = SweptCutter::sweep(path, {{1, *tool}});
  EXPECT_TRUE(swept);
  return *swept;
}

// Place of the tip along X at a moment.
double x_of(const SweptCutter& swept, const PathState& moment) {
  const auto& path = swept.path();
  const auto& segment = path.segments[moment.segment];
  return kinematics::between(path.from(segment), path.to(segment), moment.t).tip.x();
}

std::vector<PathState> range_at(const SweptCutter& swept, const Vec3& point, const Vec3& outward) {
  const Ray ray{point + 0.5 * outward, -outward};
  const IntervalSet covered = swept.along(ray, {0.0, 1.0});
  EXPECT_EQ(covered.intervals().size(), 1U);
  const Interval& i = covered.intervals().front();
  const auto contact = swept.contact(ray, i.hi, static_cast<std::uint32_t>(i.hi_tag));
  return contact_range(swept, {contact.segment, contact.t}, point);
}

TEST(ContactRange, ASideFaceTouchesAPointAtOneMoment) {
  const SweptCutter swept =
      pass({{Vec3(-50, 0, 0), Vec3::UnitZ()}, {Vec3(50, 0, 0), Vec3::UnitZ()}});
  const auto range = range_at(swept, Vec3(7, -10, 3), Vec3::UnitY());
  EXPECT_NEAR(x_of(swept, range.front()), 7.0,
              0.01);  // 2 nm of a circle of 10 mm: 6 um to each side
  EXPECT_NEAR(x_of(swept, range.back()), 7.0, 0.01);
}

TEST(ContactRange, AFlatEndFaceTouchesAPointForAsLongAsItIsUnderTheFace) {
  const SweptCutter swept = pass({{Vec3(-50, 0, 0), Vec3::UnitZ()},
                                  {Vec3(4, 0, 0), Vec3::UnitZ()},
                                  {Vec3(9, 0, 0), Vec3::UnitZ()},
                                  {Vec3(50, 0, 0), Vec3::UnitZ()}});
  const auto range = range_at(swept, Vec3(7, 6, 0), Vec3::UnitZ());
  EXPECT_NEAR(x_of(swept, range.front()), 7.0 - 8.0, 1e-5);  // chord of the disc at y = 6
  EXPECT_NEAR(x_of(swept, range.back()), 7.0 + 8.0, 1e-5);
  EXPECT_GE(range.size(), 4U);  // with the two ends of segments between
}

TEST(ContactRange, ALeaningEndFaceTouchesWithItsRimOnly) {
  const Vec3 axis = Vec3(1e-4, 0, 1).normalized();
  const SweptCutter swept = pass({{Vec3(-50, 0, 0), axis}, {Vec3(50, 0, 0), axis}});
  // Leaning forward, the rim behind the tip is the deepest: 8 mm behind at y = 6.
  const Vec3 point(7, 6, -8.0 * 1e-4);
  const auto range = range_at(swept, point, Vec3::UnitZ());
  EXPECT_NEAR(std::abs(x_of(swept, range.front()) - 7.0), 8.0, 0.05);
  EXPECT_NEAR(x_of(swept, range.front()), x_of(swept, range.back()), 0.05);
}

TEST(ContactRange, EndsWithTheBlock) {
  const SweptCutter swept = pass({{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(5, 0, 0), Vec3::UnitZ()}});
  const auto range = range_at(swept, Vec3(2, 0, 0), Vec3::UnitZ());
  EXPECT_EQ(x_of(swept, range.front()), 0.0);
  EXPECT_EQ(x_of(swept, range.back()), 5.0);
}

}  // namespace
}  // namespace frustum::cutter

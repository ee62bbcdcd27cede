// Perfect parts of which few points, or oddly placed ones, are known: their form is none, or it is
// refused with the reason.
#include <gmock/gmock.h>

#include <cmath>

#include "measured_feature.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

Result<CharacteristicResult> part_evaluated(const PlannedCharacteristic& planned,
                                            const FittedFeature& feature) {
  return evaluate(planned, std::span(&feature, 1));
}

// Points on circles about z: angles, heights and sections of a round surface.
struct PartSpot {
  double angle = 0.0;
  double height = 0.0;
  std::size_t section = 0;
  double off = 0.0;  // mm, out of the axis
};
FittedFeature round_one(const PlannedFeature& planned, const Pose& lies,
                        const std::vector<PartSpot>& spots) {
  std::vector<Vec3> points;
  std::vector<std::size_t> sections;
  for (const PartSpot& s : spots) {
    const double r = planned.radius + s.off;
    points.push_back(
        lies.point(planned.point + Vec3(r * std::cos(s.angle), r * std::sin(s.angle), s.height)));
    sections.push_back(s.section);
  }
  auto fitted = fit_feature(planned, points, sections, 0.0);
  EXPECT_TRUE(fitted) << to_string(fitted.error().front());
  return fitted ? *fitted : FittedFeature{};
}

PlannedFeature circle() {
  PlannedFeature f = measured::cylinder("ring", {3, -4, 5}, Vec3::UnitZ(), 20.0, {0.0});
  f.kind = FeatureKind::circle;
  return f;
}

std::vector<PartSpot> arc_of(double degrees, int sections) {
  std::vector<PartSpot> spots;
  for (int k = 0; k < sections; ++k) {
    for (int i = 0; i < 25; ++i) {
      spots.push_back(
          {1.0 + degrees * kRadPerDeg * i / 25.0, 8.0 * k, static_cast<std::size_t>(k)});
    }
  }
  return spots;
}

TEST(CircumscribedForms, Attack3_5_OfLessThanHalfATurnAreRefused) {
  const PlannedFeature part = measured::cylinder("bore", {3, -4, 5}, Vec3::UnitZ(), 20.0);
  const Pose lies = measured::turned(Vec3(0.6, 0.8, 0.0), 0.1);
  for (const double degrees : {20.0, 90.0, 170.0, 200.0, 360.0}) {
    for (const PlannedFeature& planned : {part, circle()}) {
      const bool is_circle = planned.kind == FeatureKind::circle;
      const FittedFeature found = round_one(planned, lies, arc_of(degrees, is_circle ? 1 : 3));
      for (const K kind : {K::roundness, K::cylindricity}) {
        if (is_circle && kind == K::cylindricity) continue;
        const auto value = part_evaluated(
            measured::characteristic(kind, {planned.name}, Criterion::minimum_circumscribed),
            found);
        if (value) {
          EXPECT_LT(value->value, 1e-6) << degrees << " deg, " << name_of(kind);
        } else {
          EXPECT_LT(degrees, 360.0) << to_string(value.error().front());
          EXPECT_THAT(value.error().front().id.text(), testing::StartsWith("association-"));
        }
      }
    }
  }
}

TEST(InscribedForms, Attack3_11_OfArcsThatLeaveRoomForALargerOneAreRefused) {
  const PlannedFeature part = measured::cylinder("pin", {3, -4, 5}, Vec3::UnitZ(), 20.0);
  const Pose lies = measured::turned(Vec3(0.6, 0.8, 0.0), 0.1);
  for (const double shift : {0.0, 90.0, 180.0}) {
    for (const double degrees : {90.0, 360.0}) {
      std::vector<PartSpot> spots = arc_of(degrees, 3);
      for (PartSpot& s : spots) s.angle += shift * kRadPerDeg * static_cast<double>(s.section);
      const auto value = part_evaluated(
          measured::characteristic(K::cylindricity, {"pin"}, Criterion::maximum_inscribed),
          round_one(part, lies, spots));
      if (value) {
        EXPECT_LT(value->value, 1e-6) << degrees << " deg, turned by " << shift;
      } else {
        EXPECT_LT(degrees, 360.0) << to_string(value.error().front());
        EXPECT_THAT(value.error().front().id.text(), testing::StartsWith("association-"));
      }
    }
  }
}

TEST(CircleForms, Attack3_6_HeightsOfACircleMakeNoForm) {
  synthetic::Draws draws(36);
  for (int i = 0; i < 60; ++i) {
    const PlannedFeature planned = circle();
    const Pose lies{rotation_about(draws.direction(), draws.between(-0.3, 0.3)), draws.place(20.0)};
    const double arc = i % 3 == 0 ? 360.0 : i % 3 == 1 ? 90.0 : 20.0;
    const double height = i % 2 == 0 ? 0.0 : 0.05;
    std::vector<PartSpot> spots = arc_of(arc, 1);
    for (PartSpot& s : spots) s.height = draws.between(-height, height);
    const auto value = part_evaluated(measured::characteristic(K::roundness, {"ring"}),
                                      round_one(planned, lies, spots));
    if (value) {
      EXPECT_LT(value->value, 1e-6) << arc << " deg, heights of " << height << " mm";
    } else {
      EXPECT_EQ(value.error().front().id.text(), "section-height");
      EXPECT_GT(height, 0.0);
    }
  }
  // What a CMM makes of heights is no reason to refuse a form.
  for (const double arc : {360.0, 20.0}) {
    std::vector<PartSpot> spots = arc_of(arc, 1);
    for (PartSpot& s : spots) s.height = draws.between(-0.002, 0.002);
    for (PartSpot& s : spots) s.off = draws.between(-0.002, 0.002);
    EXPECT_TRUE(part_evaluated(measured::characteristic(K::roundness, {"ring"}),
                               round_one(circle(), {}, spots)))
        << arc;
  }
}

// Three lobes: straight generatrices, at whatever angles.
TEST(GeneratrixForms, Attack3_7_OfDenseSectionsAreNotMixed) {
  const PlannedFeature part = measured::cylinder("bore", {3, -4, 5}, Vec3::UnitZ(), 20.0);
  for (const int count : {36, 720, 1500}) {
    std::vector<PartSpot> spots;
    for (std::size_t k = 0; k < 4; ++k) {
      for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        spots.push_back({angle, 8.0 * static_cast<double>(k), k, 0.005 * std::cos(3.0 * angle)});
      }
    }
    const auto value = part_evaluated(measured::characteristic(K::straightness, {"bore"}),
                                      round_one(part, {}, spots));
    ASSERT_TRUE(value) << to_string(value.error().front());
    EXPECT_LT(value->value, 1e-6) << count;
  }
  // Arcs without a generatrix: three neighbours of one section are none.
  std::vector<PartSpot> spots;
  for (std::size_t k = 0; k < 4; ++k) {
    for (int i = 0; i < 20; ++i)
      spots.push_back({1.5 * static_cast<double>(k) + 0.003 * i, 8.0 * static_cast<double>(k), k});
  }
  const auto none = part_evaluated(measured::characteristic(K::straightness, {"bore"}),
                                   round_one(part, {}, spots));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().front().id.text(), "too-few-points");
}

}  // namespace
}  // namespace frustum::metrology

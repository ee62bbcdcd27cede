// What was found wrong with measured values, each by its number.
#include <gmock/gmock.h>

#include <cmath>

#include "measured_feature.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/decision_rule.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using measured::feature;
using measured::turned;

TEST(Limits, Fault2_60_AValueOnItsLimitPasses) {
  CharacteristicResult c;
  for (const double diameter : {0.3, 10.0, 333.0}) {
    for (const double tolerance : {0.001, 0.01, 0.07}) {
      for (const double side : {-1.0, 1.0}) {
        c.nominal = diameter;
        c.tolerance = tolerance;
        for (const DecisionRule rule : {DecisionRule::simple, DecisionRule::iso14253}) {
          c.value = diameter + side * tolerance;
          EXPECT_EQ(verdict_of(c, rule), Verdict::pass) << diameter << " " << tolerance;
          c.value = diameter + side * (tolerance + 1e-12 * diameter);
          EXPECT_EQ(verdict_of(c, rule), Verdict::fail) << diameter << " " << tolerance;
        }
      }
    }
  }
}

Result<CharacteristicResult> evaluated_of(const PlannedCharacteristic& planned,
                                          const FittedFeature& feature) {
  return evaluate(planned, std::span(&feature, 1));
}

std::string complaint(const Result<CharacteristicResult>& result) {
  return result ? "" : to_string(result.error().front());
}

// Points of a perfect cylinder or cone at the angles and heights that a strategy gives, in a pose.
struct Spot {
  double angle = 0.0;
  double height = 0.0;
  std::size_t section = 0;
};
FittedFeature perfect(const PlannedFeature& planned, const Pose& lies,
                      const std::vector<Spot>& spots) {
  std::vector<Vec3> points;
  std::vector<std::size_t> sections;
  for (const Spot& s : spots) {
    const double r = planned.radius + s.height * std::tan(planned.half_angle);
    points.push_back(
        lies.point(planned.point + Vec3(r * std::cos(s.angle), r * std::sin(s.angle), s.height)));
    sections.push_back(s.section);
  }
  auto fitted = fit_feature(planned, points, sections, 0.0);
  EXPECT_TRUE(fitted) << to_string(fitted.error().front());
  return fitted ? *fitted : FittedFeature{};
}

PlannedFeature round_part(double half_angle) {
  PlannedFeature part = measured::cylinder("bore", {3, -4, 5}, Vec3::UnitZ(), 10.0);
  part.half_angle = half_angle;
  if (half_angle > 0.0) part.kind = FeatureKind::cone;
  return part;
}

std::vector<Spot> scattered_arcs(synthetic::Draws& draws, double arc, int sections) {
  std::vector<Spot> spots;
  for (int k = 0; k < sections; ++k) {
    const double start = draws.between(0.0, 6.0);
    for (int i = 0; i < 25; ++i) {
      spots.push_back({start + arc * (i + draws.between(0.0, 0.8)) / 25.0,
                       8.0 * k + draws.between(-0.05, 0.05), static_cast<std::size_t>(k)});
    }
  }
  return spots;
}

class RoundParts : public testing::TestWithParam<double> {};

TEST_P(RoundParts, Fault2_47_SectionsOfPerfectPartsAreRoundHoweverTheyAreTouched) {
  const PlannedFeature part = round_part(GetParam());
  synthetic::Draws draws(47);
  for (int i = 0; i < 40; ++i) {
    const Pose lies{rotation_about(draws.direction(), draws.between(-0.3, 0.3)), draws.place(20.0)};
    const double arc = i % 2 == 0 ? 2.0 * std::numbers::pi : 20.0 * kRadPerDeg;
    const FittedFeature found = perfect(part, lies, scattered_arcs(draws, arc, 4));
    for (const K kind : {K::roundness, K::axis_straightness}) {
      const auto value = evaluated_of(measured::characteristic(kind, {"bore"}), found);
      ASSERT_TRUE(value) << complaint(value);
      EXPECT_LT(value->value, i % 2 == 0 ? 1e-9 : 1e-6) << name_of(kind);  // um
    }
    if (GetParam() > 0.0) {
      const auto value =
          evaluated_of(measured::characteristic(K::equivalent_cone_form, {"bore"}), found);
      ASSERT_TRUE(value) << complaint(value);
      EXPECT_LT(value->value, 1e-6);
    }
  }
}

TEST_P(RoundParts, Fault2_47_AHelixHasNoSections) {
  const PlannedFeature part = round_part(GetParam());
  std::vector<Spot> helix;
  for (int i = 0; i < 120; ++i) helix.push_back({0.15 * i, 0.1 * i, 0});
  const FittedFeature found = perfect(part, {}, helix);
  const auto roundness = evaluated_of(measured::characteristic(K::roundness, {"bore"}), found);
  ASSERT_FALSE(roundness);
  EXPECT_EQ(roundness.error().front().id.text(), "section-height");
  EXPECT_THAT(complaint(roundness), testing::HasSubstr("section 0 of 'bore'"));
  const K form = GetParam() > 0.0 ? K::cone_form : K::cylindricity;
  EXPECT_LT(evaluated_of(measured::characteristic(form, {"bore"}), found)->value, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RoundParts, testing::Values(0.0, 30.0 * kRadPerDeg));

TEST(FlatnessFaults, Fault2_48_PeaksPointOutOfTheMaterialWhateverWayTheFaceLooks) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0),
                             Vec3(0, -1, 0), Vec3(0.6, -0.8, 0)}) {
    const auto [u, v] = tangents(unit(normal));
    const PlannedFeature face = measured::plane("F", {0, 0, 0}, normal, 40 * u, 30 * v);
    const auto bump = [](const Vec3& p) { return p.norm() < 1e-9 ? 0.010 : 0.0; };
    const FittedFeature found = feature(face, {}, bump);
    for (const Criterion criterion : {Criterion::least_squares, Criterion::minimum_zone}) {
      PlannedCharacteristic flatness = measured::characteristic(K::flatness, {"F"}, criterion);
      flatness.parameter = FormParameter::p;
      const double peak = evaluated_of(flatness, found)->value;
      flatness.parameter = FormParameter::v;
      const double valley = evaluated_of(flatness, found)->value;
      EXPECT_NEAR(peak + valley, 10.0, 1e-9);
      EXPECT_GT(peak, criterion == Criterion::least_squares ? 9.0 : 4.9);
    }
  }
}

// B is 1 mrad out of square to A, its points are six and scattered.
TEST(DatumFaults, Fault2_50_TheSecondaryDatumIsFittedAcrossTheFirst) {
  const PlannedFeature a = measured::plane("A", {0, 0, 0}, Vec3::UnitZ(), {80, 0, 0}, {0, 60, 0});
  const PlannedFeature b =
      measured::plane("B", {0, 0, -10}, -Vec3::UnitY(), {80, 0, 0}, {0, 0, 16});
  const std::vector<Vec3> places{{-40, 0, -2}, {-25, 0, -17}, {-3, 0, -16},
                                 {8, 0, -3},   {24, 0, -5},   {37, 0, -18}};
  std::vector<Vec3> points;
  for (const Vec3& p : places) points.emplace_back(p.x(), 1e-3 * p.z(), p.z());
  const auto measured_b = fit_feature(b, points, std::vector<std::size_t>(6, 0), 0.0);
  ASSERT_TRUE(measured_b);
  DatumSystem system;
  system.primary = "A";
  system.secondary = "B";
  const std::vector<FittedFeature> features{feature(a), *measured_b};
  const auto found = found_datum(system, features);
  ASSERT_TRUE(found);
  // The least-squares line y = a + b x through the places, as points seen along A.
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const Vec3& p : points) {
    sx += p.x();
    sy += p.y();
    sxx += p.x() * p.x();
    sxy += p.x() * p.y();
  }
  const double slope = (6.0 * sxy - sx * sy) / (6.0 * sxx - sx * sx);
  EXPECT_GT(std::abs(slope), 1e-5);
  const Vec3 x = found->workpiece_from_datum.direction(Vec3::UnitX());
  EXPECT_NEAR(x.y() / x.x(), slope, 1e-10);
  EXPECT_NEAR(x.z(), 0.0, 1e-12);
}

TEST(OrientationFaults, Fault2_51_HowALineRunsWithinItsFaceIsNoFaultOfTheFace) {
  const PlannedFeature floor =
      measured::plane("A", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  // On the face X = 30, upright as planned; scanned askew within the face by 2 mrad.
  PlannedFeature wall = measured::line("L", {30, 0, 20}, Vec3::UnitZ(), Vec3::UnitX());
  const FittedFeature askew = feature(wall, turned(Vec3::UnitX(), 2e-3, wall.point));
  const std::vector<FittedFeature> features{askew, feature(floor)};
  const auto square = evaluate(measured::characteristic(K::perpendicularity, {"L", "A"}), features);
  ASSERT_TRUE(square);
  EXPECT_LT(square->value, 1e-9);
  const std::vector<FittedFeature> leaning{feature(wall, turned(Vec3::UnitY(), 2e-3, wall.point)),
                                           feature(floor)};
  EXPECT_NEAR(evaluate(measured::characteristic(K::perpendicularity, {"L", "A"}), leaning)->value,
              60.0, 1e-3);
}

TEST(FormFaults, Fault2_55_AsManyPointsAsParametersHaveNoForm) {
  const PlannedFeature face =
      measured::plane("F", {0, 0, 0}, Vec3::UnitZ(), {40, 0, 0}, {0, 40, 0});
  const auto plane = fit_feature(face, {{0, 0, 0}, {10, 0, 1}, {0, 10, 2}}, {0, 0, 0}, 0.0);
  ASSERT_TRUE(plane);
  EXPECT_THAT(complaint(evaluated_of(measured::characteristic(K::flatness, {"F"}), *plane)),
              testing::HasSubstr("3 points have no form: a plane goes through all of them"));
  const PlannedFeature bore = round_part(0.0);
  const FittedFeature three =
      perfect(bore, {}, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 9, 1}, {2, 9, 1}, {4, 9, 1}});
  EXPECT_THAT(complaint(evaluated_of(measured::characteristic(K::roundness, {"bore"}), three)),
              testing::HasSubstr("section 0 of 'bore': 3 points have no form"));
}

TEST(FormFaults, Fault2_55_FewPointsGiveTheElementThatThePlanMeans) {
  synthetic::Draws draws(55);
  for (const double half_angle : {0.0, 25.0 * kRadPerDeg}) {
    const PlannedFeature part = round_part(half_angle);
    for (int i = 0; i < 50; ++i) {
      std::vector<Spot> spots;
      for (int k = 0; k < (half_angle > 0.0 ? 6 : 5); ++k) {
        const double turn = k < 3 ? 2.1 * k : 2.1 * k + 0.9;
        spots.push_back(
            {turn + draws.between(-0.3, 0.3), (k < 3 ? -8.0 : 8.0) + draws.between(-1.0, 1.0), 0});
      }
      const Pose lies{rotation_about(draws.direction(), draws.between(-0.01, 0.01)),
                      draws.place(0.1)};
      const FittedFeature found = perfect(part, lies, spots);
      const Vec3 axis = *axis_of(found.element);
      EXPECT_LT(axis.cross(lies.direction(Vec3::UnitZ())).norm(), 1e-7);
      if (const auto* cylinder = std::get_if<Cylinder>(&found.element)) {
        EXPECT_NEAR(cylinder->radius, 10.0, 1e-7);
      } else {
        EXPECT_NEAR(std::get<Cone>(found.element).half_angle, half_angle, 1e-7);
      }
    }
  }
}

// Two chords of an arc of 10 degrees are tangents of a cylinder across it, which noise may prefer.
TEST(FormFaults, ANarrowArcGivesTheElementThatThePlanMeans) {
  synthetic::Draws draws(10);
  PlannedFeature arc = measured::cylinder("arc", {0, 0, 0}, Vec3::UnitZ(), 50.0);
  for (int i = 0; i < 40; ++i) {
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (int k = 0; k < 12; ++k) {
      const double turn = 2.0 * kRadPerDeg * (k % 6);
      const double r = 50.0 + 1e-3 * draws.gauss();
      points.emplace_back(r * std::cos(turn), r * std::sin(turn), k < 6 ? 0.0 : 10.0);
      sections.push_back(k < 6 ? 0 : 1);
    }
    const auto found = fit_feature(arc, points, sections, 0.0);
    ASSERT_TRUE(found);
    EXPECT_LT(axis_of(found->element)->vec().cross(Vec3::UnitZ()).norm(), 0.01);
    EXPECT_NEAR(std::get<Cylinder>(found->element).radius, 50.0, 5.0);
  }
}

TEST(FormFaults, Fault2_56_TheWorstSectionCounts) {
  const PlannedFeature bore = measured::cylinder("bore", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const FittedFeature found = feature(bore, {}, [](const Vec3& p) {
    return p.z() > 5.0 ? 0.05 * std::cos(3.0 * std::atan2(p.y(), p.x())) : 0.0;
  });
  PlannedCharacteristic roundness = measured::characteristic(K::roundness, {"bore"});
  EXPECT_NEAR(evaluated_of(roundness, found)->value, 100.0, 0.5);
  roundness.sections = {0};
  EXPECT_LT(evaluated_of(roundness, found)->value, 0.1);
}

TEST(OrientationFaults, Fault2_57_TheZoneOfAnAngularityTurnsAboutItsDatum) {
  const PlannedFeature floor =
      measured::plane("A", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const double angle = 30.0 * kRadPerDeg;
  const Vec3 normal(std::sin(angle), 0.0, std::cos(angle));
  const Vec3 down(std::cos(angle), 0.0, -std::sin(angle));
  const PlannedFeature ramp = measured::plane("F", {0, 0, 20}, normal, 40 * down, {0, 30, 0});
  synthetic::Draws draws(57);
  for (int i = 0; i < 20; ++i) {
    const FittedFeature face =
        feature(ramp, {}, [&](const Vec3&) { return draws.between(-0.01, 0.01); });
    const std::vector<FittedFeature> features{face, feature(floor)};
    const double zone =
        evaluate(measured::characteristic(K::angularity, {"F", "A"}, Criterion::minimum_zone),
                 features)
            ->value;
    // All azimuths, finely.
    double least = HUGE_VAL;
    for (int k = -40000; k <= 40000; ++k) {
      const Vec3 along = rotation_about(Vec3::UnitZ(), 2.5e-7 * k) * normal;
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const MeasuredPoint& p : face.points) {
        low = std::min(low, p.point.dot(along));
        high = std::max(high, p.point.dot(along));
      }
      least = std::min(least, high - low);
    }
    EXPECT_LT(zone, 1e3 * least + 1e-9);
    EXPECT_GT(zone, 1e3 * least - 0.02);  // a step of the search above: 2.5e-7 rad over 40 mm
  }
}

// A round cone with a waviness of 1 um and a mark 7 um deep where the contour begins.
TEST(Roundness, Fault2_29_TheValueWithoutTheSeamIsBesideTheWhole) {
  PlannedFeature cone = measured::cylinder("K", {0, 0, 0}, Vec3::UnitZ(), 20.0, {0.0}, 360);
  cone.kind = FeatureKind::cone;
  cone.half_angle = 15.0 * kRadPerDeg;
  cone.zero = Vec3::UnitX();
  cone.strategy = SectionStrategy{{0.0, 5.0}, 360};
  const FittedFeature found = feature(cone, {}, [](const Vec3& p) {
    const double angle = std::atan2(p.y(), p.x());
    return 0.0005 * std::cos(12.0 * angle) - (std::abs(angle) < 0.0525 ? 0.007 : 0.0);
  });
  for (const K kind : {K::roundness, K::equivalent_cone_form}) {
    PlannedCharacteristic c = measured::characteristic(kind, {"K"});
    const auto whole = evaluated_of(c, found);
    ASSERT_TRUE(whole) << complaint(whole);
    EXPECT_FALSE(whole->without_seam);
    c.seam = Seam{0.0, 5.0 * kRadPerDeg};
    const auto both = evaluated_of(c, found);
    ASSERT_TRUE(both) << complaint(both);
    EXPECT_EQ(both->value, whole->value);
    EXPECT_GT(both->value, 6.5);
    ASSERT_TRUE(both->without_seam);
    // Waves of 12 per revolution; the points were moved along the normal of the surface, and a
    // roundness is across the axis.
    const double across = kind == K::roundness ? 1.0 / std::cos(cone.half_angle) : 1.0;
    // The circle of the rest is off by what the waves do beside the gap.
    EXPECT_NEAR(both->without_seam->value, across, 0.08);
    // The mark is at 0 deg, and +-5 deg about 90 deg are beside it.
    c.seam = Seam{90.0 * kRadPerDeg, 5.0 * kRadPerDeg};
    EXPECT_GT(evaluated_of(c, found)->without_seam->value, 6.5);
  }
}

TEST(DecisionRule, Fault2_52_NoVerdictRestsOnAnIntervalThatIsNotProven) {
  CharacteristicResult c;
  c.tolerance = 10.0;
  c.value = 5.0;
  c.interval = TrueValueInterval{.low = 4.0, .high = 6.0};
  EXPECT_EQ(verdict_of(c, DecisionRule::iso14253), Verdict::pass);
  c.interval->coverage = Coverage::not_proven;
  EXPECT_EQ(verdict_of(c, DecisionRule::iso14253), Verdict::uncertain);
  EXPECT_EQ(verdict_of(c, DecisionRule::simple), Verdict::pass);
}

}  // namespace
}  // namespace frustum::metrology

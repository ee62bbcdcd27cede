#include "metrology/plan/strategy.hpp"

#include <gtest/gtest.h>

#include "metrology/cmm.hpp"
#include "metrology/plan/nominal.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

PlannedFeature round(FeatureKind kind, Strategy strategy) {
  PlannedFeature f;
  f.name = "f";
  f.kind = kind;
  f.point = {3.0, -2.0, 5.0};
  f.axis = Vec3(0.2, -0.1, 1.0);
  f.radius = 20.0;
  f.half_angle = 0.4;
  f.strategy = std::move(strategy);
  return f;
}

InspectionPlan plan_of(std::vector<PlannedFeature> features) {
  InspectionPlan plan;
  for (std::size_t i = 0; i < features.size(); ++i) {
    features[i].name = "f" + std::to_string(i);
    if (features[i].kind != FeatureKind::cone) features[i].half_angle = 0.0;
  }
  plan.features = std::move(features);
  return plan;
}

// Every strategy there is, with numbers that no one would type.
std::vector<PlannedFeature> every_strategy(synthetic::Draws& draws) {
  const auto angle = [&] { return draws.between(-3.0, 3.0); };
  const auto length = [&] { return draws.between(0.1, 5.0); };
  using enum FeatureKind;
  PlannedFeature edge = round(line, LineStrategy{-length(), length(), 0, length()});
  edge.radius = 0.0;
  PlannedFeature grid = round(plane, GridStrategy{{0, 30, 0}, {30, 0, 0}, 0, 4, length(), true});
  grid.axis = Vec3::UnitZ();
  grid.radius = 0.0;
  PlannedFeature rings = round(plane, RingStrategy{{length(), 9.0}, 0, angle(), 1.5, length()});
  rings.radius = 0.0;
  return {round(cylinder, SectionStrategy{{-1.0, length()}, 0, angle(), 2.0, length(), true}),
          round(cylinder, GeneratrixStrategy{5, -length(), length(), 7, 2.0 + angle(), 6.0}),
          round(cone, GeneratrixStrategy{3, -length(), length(), 0, angle(), 2.0, length(), true}),
          round(cone, SpiralStrategy{-length(), length(), -2.7, 30, angle()}),
          round(cylinder, SpiralStrategy{length(), -length(), 3.3, 0, angle(), length(), true}),
          round(sphere, SphereStrategy{{1, 5, 7}, 0.1, length() / 2.0, angle(), angle()}),
          edge,
          grid,
          rings};
}

TEST(Strategy, TouchesTheNominalSurfaceAlongItsNormal) {
  synthetic::Draws draws(5);
  for (const PlannedFeature& feature : every_strategy(draws)) {
    const Element element = nominal_element(feature);
    const auto points = planned_points(feature);
    ASSERT_GE(points.size(), 3U);
    for (const PlannedPoint& p : points) {
      EXPECT_LT(p.section, section_count(feature));
      EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14);
      EXPECT_NEAR(residual(element, p.point), 0.0, 1e-12);
      if (feature.kind == FeatureKind::line) continue;
      EXPECT_LT((outward_normal(element, p.point) - p.normal).norm(), 1e-12);
      EXPECT_EQ(nearest_section(feature, p.point), p.section) << name_of(feature.kind);
    }
  }
}

TEST(Strategy, ReadsBackToTheLastBit) {
  synthetic::Draws draws(6);
  for (int i = 0; i < 50; ++i) {
    InspectionPlan plan = plan_of(every_strategy(draws));
    plan.probe.compensation = i % 2 == 0 ? Compensation::approach : Compensation::fitted;
    ASSERT_TRUE(check(plan).empty()) << to_string(check(plan).front());
    const auto read = parse_plan(to_toml(plan));
    ASSERT_TRUE(read) << to_string(read.error().front()) << to_toml(plan);
    EXPECT_EQ(*read, plan);
  }
}

TEST(Strategy, KeepsToItsPitch) {
  using enum FeatureKind;
  // A circumference of 125.66 mm takes 252 steps of at most 0.5 mm, the last one back to the start.
  const auto turn = planned_points(
      round(cylinder, SectionStrategy{{0.0, 4.0}, 0, 0.0, 2 * std::numbers::pi, 0.5}));
  EXPECT_EQ(turn.size(), 504U);
  EXPECT_FALSE(turn.front().scanned);
  // An arc of 2 rad, 40 mm: 80 steps and both ends.
  EXPECT_EQ(planned_points(round(cylinder, SectionStrategy{{0.0}, 0, 0.0, 2.0, 0.5})).size(), 81U);
  const auto rows =
      planned_points(round(cylinder, GeneratrixStrategy{3, 0.0, 2.1, 0, 0.0, 1.0, 0.3, true}));
  EXPECT_EQ(rows.size(), 24U);  // 2.1 / 0.3 is 7 but for rounding
  EXPECT_TRUE(rows.front().scanned);
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_NEAR((rows[i].point - rows[i - 1].point).norm(), 0.3, 1e-12);
  }
  const auto spiral =
      planned_points(round(cone, SpiralStrategy{-5.0, 5.0, 3.0, 0, 0.0, 0.25, true}));
  double longest = 0.0;
  for (std::size_t i = 1; i < spiral.size(); ++i) {
    longest = std::max(longest, (spiral[i].point - spiral[i - 1].point).norm());
  }
  EXPECT_LE(longest, 0.26);  // the cone's own slope adds to the helix
  EXPECT_GT(longest, 0.23);
}

TEST(Strategy, KnowsThePatternOf25Points) {
  PlannedFeature ball = round(FeatureKind::sphere, SphereStrategy{});
  ball.axis = Vec3::UnitZ();
  const auto points = planned_points(ball);
  ASSERT_EQ(points.size(), 25U);
  std::map<long, int> circles;  // by polar angle in tenths of a degree
  std::map<long, std::vector<double>> azimuths;
  for (const PlannedPoint& p : points) {
    const long polar = std::lround(10.0 * kDegPerRad * std::acos(p.normal.z()));
    ++circles[polar];
    azimuths[polar].push_back(kDegPerRad * std::atan2(p.normal.y(), p.normal.x()));
  }
  EXPECT_EQ(circles, (std::map<long, int>{{0, 1}, {225, 4}, {450, 8}, {675, 4}, {900, 8}}));
  // Each circle is turned by 22.5 deg against the one before.
  EXPECT_NEAR(azimuths[450][0] - azimuths[225][0], 22.5, 1e-9);
  EXPECT_NEAR(azimuths[675][0] - azimuths[450][0], 22.5, 1e-9);
  EXPECT_NEAR(azimuths[900][0] - azimuths[675][0], 22.5, 1e-9);
}

TEST(Strategy, NamesWhatIsImpossible) {
  const auto complaint = [](FeatureKind kind, Strategy strategy) {
    const Diagnostics found = check(plan_of({round(kind, std::move(strategy))}));
    return found.empty() ? std::string() : to_string(found.front());
  };
  using enum FeatureKind;
  EXPECT_EQ(
      complaint(circle, SpiralStrategy{}),
      "error: feature[1].strategy: this strategy does not suit a circle (hint: plane: rings or "
      "grid; line: from, to, points; sphere: points of each circle, or sections; circle: "
      "sections; ruled: heights, from, to, points; others: sections, generatrices or turns)");
  EXPECT_EQ(complaint(cylinder, SectionStrategy{{0.0, 1.0}, 12, 0.0, 1.0, 0.5}),
            "error: feature[1].strategy: points_per_section and pitch exclude each other");
  EXPECT_EQ(complaint(cylinder, GeneratrixStrategy{2, 0.0, 0.0, 5, 0.0, 1.0}),
            "error: feature[1].strategy: at least 3 generatrices, planned are 2");
  EXPECT_EQ(complaint(cylinder, SpiralStrategy{1.0, 1.0}),
            "error: feature[1].strategy: from = 1 and to = 1 must be different heights");
  EXPECT_EQ(complaint(cylinder, SpiralStrategy{0.0, 1.0, 0.5}),
            "error: feature[1].strategy: a spiral takes one turn or more, planned are 0.5");
  EXPECT_EQ(complaint(cone, SpiralStrategy{0.0, -60.0}),
            "error: feature[1].strategy: the section at -60 mm is beyond the apex (hint: sections "
            "count from point toward growing radius)");
  EXPECT_EQ(complaint(cylinder, SpiralStrategy{0.0, 1.0, 3.0, 0, 0.0, 1e-6}),
            "error: feature[1].strategy: a pitch of 1e-06 mm makes more than 1000000 points of "
            "376.992 mm");
  EXPECT_EQ(complaint(sphere, SphereStrategy{{1, 0}}),
            "error: feature[1].strategy: a sphere needs 2 or more circles with 5 or more points in "
            "all, planned are 2 circles with 1 point");
  EXPECT_EQ(complaint(sphere, SphereStrategy{{1, 4}, 0.0, 4.0}),
            "error: feature[1].strategy: polar_from = 0 deg and polar_to = 229.183 deg must be "
            "different angles from 0 to 180 deg");
  const auto read = parse_plan(
      "title = \"x\"\n[probe]\nball_diameter = 3\n[[feature]]\nname = \"a\"\nkind = \"cylinder\"\n"
      "point = [0, 0, 0]\naxis = [0, 0, 1]\nradius = 5\n"
      "strategy = { generatrices = 4, from = 0, to = 5, points = 3, pitch = 1 }\n",
      "p.toml");
  ASSERT_FALSE(read);
  EXPECT_EQ(to_string(read.error().front()),
            "p.toml:10:62: error: feature[1].strategy.pitch: points and pitch exclude each other");
}

}  // namespace
}  // namespace frustum::metrology

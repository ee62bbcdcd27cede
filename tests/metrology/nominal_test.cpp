#include "metrology/plan/nominal.hpp"

#include <gtest/gtest.h>

#include "metrology/plan/strategy.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

TEST(DeviationFromNominal, IsTheDistanceAlongTheNormalOfTheOwningFeature) {
  const InspectionPlan plan = test_part::plan();
  for (const PlannedFeature& feature : plan.features) {
    for (const PlannedPoint& p : planned_points(feature)) {
      for (const double off : {-0.02, 0.0, 0.3}) {
        const auto deviation = deviation_from_nominal(plan, p.point + off * p.normal, p.normal);
        ASSERT_TRUE(deviation) << feature.name;
        EXPECT_NEAR(*deviation, off, 1e-12) << feature.name;
      }
    }
  }
}

TEST(DeviationFromNominal, LeavesOtherSurfacesAlone) {
  const InspectionPlan plan = test_part::plan();
  EXPECT_FALSE(deviation_from_nominal(plan, {30, 0, 1.5}, Vec3::UnitZ()));   // too far off
  EXPECT_FALSE(deviation_from_nominal(plan, {30, 0, 0}, Vec3::UnitX()));     // another direction
  EXPECT_FALSE(deviation_from_nominal(plan, {70, 0, 0}, Vec3::UnitZ()));     // outside the extent
  EXPECT_FALSE(deviation_from_nominal(plan, {25, 0, 15.5}, Vec3::UnitX()));  // above the cylinder
}

TEST(DeviationFromNominal, ReachesEdgesThatErrorsHaveMoved) {
  InspectionPlan plan;
  plan.features.resize(1);
  PlannedFeature& face = plan.features.front();
  face.kind = FeatureKind::plane;
  const auto at = [&](double x) { return deviation_from_nominal(plan, {x, 0, 0}, Vec3::UnitZ()); };
  face.extent = RadialExtent{5.0, 20.0};
  for (const double edge : {4.97, 20.03}) EXPECT_TRUE(at(edge)) << edge;
  for (const double beside : {4.9, 20.1}) EXPECT_FALSE(at(beside)) << beside;
  face.extent = RectangleExtent{{40, 0, 0}, {0, 2, 0}};
  EXPECT_TRUE(at(20.03));
  EXPECT_FALSE(at(20.1));
}

TEST(DeviationFromNominal, IsPositiveInsideAHoleWhereMaterialIsLeft) {
  InspectionPlan plan;
  PlannedFeature bore;
  bore.name = "bore";
  bore.kind = FeatureKind::cylinder;
  bore.radius = 10.0;
  bore.side = Side::inside;
  bore.strategy = SectionStrategy{{0.0, 5.0}, 8};
  plan.features = {bore};
  EXPECT_NEAR(deviation_from_nominal(plan, {9.9, 0, 2}, -Vec3::UnitX()).value_or(-1.0), 0.1, 1e-12);
  EXPECT_FALSE(deviation_from_nominal(plan, {9.9, 0, 2}, Vec3::UnitX()));
}

}  // namespace
}  // namespace frustum::metrology

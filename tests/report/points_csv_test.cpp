#include "report/exchange/points_csv.hpp"

#include <gtest/gtest.h>

namespace frustum::report {
namespace {

TEST(PointsCsv, WritesOneLineAPointWithAllDigits) {
  metrology::Measurement measurement;
  metrology::MeasuredFeature feature;
  feature.name = "cone, \"upper\"";
  feature.points = {{Vec3(0.1, -2.0, 3.5), Vec3::UnitZ(), 0.0, 4}};
  measurement.features = {feature};
  EXPECT_EQ(points_csv(measurement, {}),
            "feature,section,x,y,z\n\"cone, \"\"upper\"\"\",4,0.10000000000000001,-2,3.5\n");
}

TEST(PointsCsv, Fault2_44_HasThePlannedPlaceItsNormalAndTheDeviation) {
  metrology::InspectionPlan plan;
  // A hole of radius 10 about Z: its material is outside, normals point to the axis.
  plan.features = {{.name = "bore",
                    .kind = metrology::FeatureKind::cylinder,
                    .radius = 10.0,
                    .side = metrology::Side::inside}};
  metrology::Measurement measurement;
  metrology::MeasuredFeature bore;
  bore.name = "bore";
  bore.points = {{Vec3(10.25, 0.0, 3.0), -Vec3::UnitX(), 0.0, 1}};
  measurement.features = {bore};
  EXPECT_EQ(points_csv(measurement, plan),
            "feature,section,x,y,z,nominal_x,nominal_y,nominal_z,i,j,k,deviation\n"
            "bore,1,10.25,0,3,10,0,3,-1,-0,-0,-0.25\n");
}

}  // namespace
}  // namespace frustum::report

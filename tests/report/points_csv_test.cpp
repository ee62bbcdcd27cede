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
  EXPECT_EQ(points_csv(measurement),
            "feature,section,x,y,z\n\"cone, \"\"upper\"\"\",4,0.10000000000000001,-2,3.5\n");
}

}  // namespace
}  // namespace frustum::report

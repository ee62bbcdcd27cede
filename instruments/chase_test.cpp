#include "instruments/chase_test.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {

Result<MotionTest> chase_test(const kinematics::Machine& machine, const ChaseTest& chase) {
  if (chase.rotary.empty()) {
    return error("no-samples"_id, "the R-test has no poses",
                 "give rotary positions, for example \"A=-90,C=0;A=0,C=60\"");
  }
  MotionTest test{.table_ball = chase.table_ball, .tool_length = chase.tool_length};
  for (const kinematics::AxisPositions& rotary : chase.rotary) {
    const auto number = static_cast<double>(test.poses.size() + 1);
    const auto q = place_tip(machine, chase.table_ball, chase.tool_length, rotary);
    if (!within_travel(machine, q)) {
      return error("axis-overtravel"_id,
                   fmt::format("pose {} of the R-test cannot be reached: {}", number,
                               fmt::join(travel_violations(machine, q), "; ")),
                   "use other rotary positions or another place of the table ball");
    }
    test.poses.push_back({number, q, chase.table_ball});
  }
  return test;
}

Result<Vec3> nest_displacement(const Mat3& directions, const Vec3& readings) {
  // Unit directions whose volume is a millionth lose six digits.
  constexpr double kFlat = 1e-6;
  if (!(std::abs(directions.determinant()) > kFlat)) {
    return error("nest-flat"_id, "the directions of the three probes are in one plane");
  }
  return Vec3(directions.inverse() * readings);
}

double sphere_term(const Vec3& displacement, const Vec3& direction, double radii) {
  const Vec3 across = displacement - displacement.dot(direction) * direction;
  return across.squaredNorm() / (2.0 * radii);
}

}  // namespace frustum::instruments

// Error maps of a table's axes A and C from R-tests with three balls.
//
// Model    : an R-test reads how far the tip is from a table ball p: a table that is off by d and
//            turned by t about the crossing of the axes shows -R^T (d + t x R p). The readings
//            where both axes are zero say where the balls are and are taken off; least squares over
//            the balls of each pose gives d and t, which are divided among the axes as touches are
//            (table_maps.hpp), in the same gauge
// Units    : mm, rad; balls in the frame of the table, readings as readings.hpp has them
// Shape    : a list of readings a ball, in the order of the plan's tilts, each with all its turns
// Errors   : balls-in-line: three balls that leave a turn about their line open, or fewer than
//            three
// Accuracy : second order in the errors; the offset of the nest in the spindle stays while the
//            table turns and appears as an error of A and C
// Source   : Weikert 2004 (R-test); Ibaraki, Iritani, Matsushita for the division
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "instruments/table_maps.hpp"

namespace frustum::instruments {

// The rotary positions at which the R-tests of a plan are run.
[[nodiscard]] std::vector<kinematics::AxisPositions> ball_poses(const TouchPlan& plan);

[[nodiscard]] Result<TableMaps> maps_of_balls(const TouchPlan& plan, std::span<const Vec3> balls,
                                              const std::vector<std::vector<Vec3>>& readings);

// What the readings are made of, to first order, ball by ball, pose by pose, x y z; columns: the
// place of each ball, then the six errors of each pose but the first.
[[nodiscard]] Eigen::MatrixXd reading_model(const TouchPlan& plan, std::span<const Vec3> balls);

// Standard deviations for independent noise of one standard deviation in each coordinate.
[[nodiscard]] Result<TableMaps> deviations_of_balls(const TouchPlan& plan,
                                                    std::span<const Vec3> balls, double noise);

}  // namespace frustum::instruments

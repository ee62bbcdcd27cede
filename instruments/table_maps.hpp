// Error maps of a table's axes A and C from touches at indexed positions.
//
// Model    : touches where both axes are zero say how the artefact stands; turned by R_A R_C they
//            are where every other touch should be. Least squares of
//              [n, p x n] . (dx dy dz da db dc) = n . (touch - p)
//            gives the pose of each indexed position; then
//              A_i = mean over C of the poses,  C_ij = R_A^-1 (pose_ij - A_i)
//            for translations and rotations alike. What is constant over C belongs to A: over the
//            positions of C every component of C_ij sums to zero
//            Gauge: the pose at zero is zero. Its error e = A_1 + C_11 is not seen and turns with
//            the table: identified pose = pose - R_A R_C e
// Units    : mm, rad; components x y z a b c in the frame where A stands, about the crossing
// Shape    : maps by the positions of the plan
// Errors   : none; a plan whose touches leave a pose open gives numbers that are not finite
// Accuracy : second order in the errors: 0.0002 um and 0.0004 urad at 7 um and 30 urad
//            (tests/instruments/touch_test.cpp)
// Source   : Ibaraki, Iritani, Matsushita, equations (6) to (13); the gauge is ours
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "instruments/motion_test.hpp"
#include "instruments/touch_plan.hpp"
#include "kinematics/model/geometric_errors.hpp"

namespace frustum::instruments {

using ErrorVector = Eigen::Matrix<double, 6, 1>;

struct TableMaps {
  std::vector<ErrorVector> tilt{};                // of A, by its positions
  std::vector<std::vector<ErrorVector>> turn{};   // of C, by those of A and C
  std::vector<std::vector<ErrorVector>> poses{};  // of the table, likewise
};

// Poses by the positions of A and C, divided among the axes.
[[nodiscard]] TableMaps maps_of_poses(const TouchPlan& plan,
                                      std::vector<std::vector<ErrorVector>> poses);

// `readings`: of the plan's touches, outward along the nominal normals (touch_test.hpp).
[[nodiscard]] TableMaps identified_maps(const TouchPlan& plan, std::span<const double> readings);

// What the readings are made of, to first order, those at zero among them: a row a touch; columns:
// how far out each point is, then the six errors of each pose but that at zero. More readings than
// unknowns: what is left over says whether they agree.
[[nodiscard]] Eigen::MatrixXd reading_model(const TouchPlan& plan);

// Standard deviations for independent noise of one standard deviation in each touch. The touches
// at zero are in every pose, so that the estimates are correlated.
[[nodiscard]] TableMaps standard_deviations(const TouchPlan& plan, double noise);

// What of the errors of A and C a calibration sees, in its gauge, to first order: poses, less
// that at zero, divided among the axes as above. `poses`: of touch_test.hpp.
[[nodiscard]] TableMaps visible_maps(const kinematics::Machine& machine,
                                     const kinematics::GeometricErrors& errors,
                                     const TouchPlan& plan, std::span<const TestPose> poses);

}  // namespace frustum::instruments

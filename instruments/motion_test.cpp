#include "instruments/motion_test.hpp"

#include <algorithm>

namespace frustum::instruments {

using kinematics::AxisLetter;

void take_poses(MotionTest& test, std::span<const double> angles,
                const std::function<TestPose(double)>& pose) {
  test.polynomials = std::make_shared<const AnglePolynomials>(angles);
  test.poses.clear();
  const auto row_of = [&](std::size_t i) {
    const TestPose at = pose(angles[i]);
    Eigen::RowVectorXd row(6);
    row << at.at.q[AxisLetter::X], at.at.q[AxisLetter::Y], at.at.q[AxisLetter::Z],
        at.spindle_ball.transpose();
    return row;
  };
  const auto all = test.polynomials->at_all(6, row_of);
  if (!all) {
    for (const double angle : angles) test.poses.push_back(pose(angle));
    return;
  }
  // Which rotary axes turn with the angle: none, or one.
  const TestPose first = pose(angles.front()), last = pose(angles.back());
  test.poses.assign(angles.size(), first);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    TestPose& at = test.poses[i];
    const auto row = static_cast<Eigen::Index>(i);
    at.parameter = angles[i];
    at.at.q[AxisLetter::X] = (*all)(row, 0);
    at.at.q[AxisLetter::Y] = (*all)(row, 1);
    at.at.q[AxisLetter::Z] = (*all)(row, 2);
    at.spindle_ball = all->row(row).tail<3>().transpose();
    for (const AxisLetter letter : kinematics::kRotaryAxes) {
      if (first.at.q[letter] != last.at.q[letter]) at.at.q[letter] = angles[i];
    }
  }
}

}  // namespace frustum::instruments

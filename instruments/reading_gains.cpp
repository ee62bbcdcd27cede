#include "instruments/reading_gains.hpp"

#include "kinematics/model/chain.hpp"

namespace frustum::instruments {
namespace {

using kinematics::Machine;
using kinematics::MachineError;

Eigen::Index size_of(std::size_t count) { return static_cast<Eigen::Index>(count); }

}  // namespace

ReadingGains bar_gains(const Machine& machine, std::span<const MachineError> errors,
                       const MotionTest& test) {
  const Eigen::Index rows = size_of(test.poses.size());
  const Eigen::Index columns = size_of(errors.size());
  // u . G, u . R, u
  const auto row_of = [&](std::size_t i) {
    const TestPose& pose = test.poses[i];
    const Eigen::RowVector3d u = (pose.spindle_ball - test.table_ball).normalized().transpose();
    Eigen::RowVectorXd row(columns + 6);
    row << u * gain_matrix(machine, errors, pose.at.q, test.tool_length).topRows<3>(),
        u * nominal_pose(machine, pose.at.q, test.tool_length).rotation, u;
    return row;
  };
  ReadingGains gains;
  gains.of_test.resize(rows, 4);
  gains.of_test.col(3).setConstant(-1.0);
  if (test.polynomials) {
    if (const auto few = test.polynomials->coefficients(columns + 6, row_of)) {
      const Eigen::MatrixXd& basis = test.polynomials->basis();
      gains.errors.noalias() = basis * few->leftCols(columns);
      gains.ball.noalias() = basis * few->middleCols<3>(columns);
      gains.of_test.leftCols<3>().noalias() = basis * -few->rightCols<3>();
      return gains;
    }
  }
  gains.errors.resize(rows, columns);
  gains.ball.resize(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Eigen::RowVectorXd row = row_of(static_cast<std::size_t>(i));
    gains.errors.row(i) = row.head(columns);
    gains.ball.row(i) = row.segment<3>(columns);
    gains.of_test.row(i).head<3>() = -row.tail<3>();
  }
  return gains;
}

ReadingGains displacement_gains(const Machine& machine, std::span<const MachineError> errors,
                                const MotionTest& test) {
  const Eigen::Index rows = 3 * size_of(test.poses.size());
  ReadingGains gains{.errors = Eigen::MatrixXd(rows, size_of(errors.size())),
                     .ball = Eigen::MatrixXd(rows, 3),
                     .of_test = Eigen::MatrixXd(rows, 3)};
  for (Eigen::Index i = 0; i < rows; i += 3) {
    const auto& q = test.poses[static_cast<std::size_t>(i / 3)].at.q;
    gains.errors.middleRows<3>(i) = gain_matrix(machine, errors, q, test.tool_length).topRows<3>();
    gains.ball.middleRows<3>(i) = nominal_pose(machine, q, test.tool_length).rotation;
    gains.of_test.middleRows<3>(i) = -Mat3::Identity();
  }
  return gains;
}

ReadingGains line_gains(const Machine& machine, std::span<const MachineError> errors,
                        const LineTest& line, double tool_length) {
  const Eigen::Index rows = size_of(line.poses.size());
  const Eigen::RowVector3d e = line.direction.transpose();
  ReadingGains gains{.errors = Eigen::MatrixXd(rows, size_of(errors.size())),
                     .ball = Eigen::MatrixXd(rows, 3),
                     .of_test = Eigen::MatrixXd::Constant(rows, 1, -1.0)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& q = line.poses[static_cast<std::size_t>(i)].at.q;
    gains.errors.row(i) = e * gain_matrix(machine, errors, q, tool_length).topRows<3>();
    gains.ball.row(i) = e * nominal_pose(machine, q, tool_length).rotation;
  }
  return gains;
}

MotionTest thinned(const MotionTest& test, std::size_t most) {
  if (test.poses.size() <= most) return test;
  MotionTest few = test;
  few.poses.clear();
  few.polynomials.reset();
  for (std::size_t i = 0; i < most; ++i) {
    few.poses.push_back(test.poses[i * test.poses.size() / most]);
  }
  return few;
}

}  // namespace frustum::instruments

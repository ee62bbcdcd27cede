// One exact step of a linear system whose input is linear in time within it.
//
// Model    : y' = A y + v (first-order hold), by matrices for many steps or by a series for few:
//              TimeStep    y1 = E y0 + B0 v0 + B1 v1 with E = exp(A h) and the integrals of
//                          exp(A (h - t)) (1 - t/h) and exp(A (h - t)) t/h
//              SeriesStep  Taylor series of y about the beginning: y'' = A y' + v', then
//                          y(k) = A y(k-1), until its terms are rounding. The first rows of A only
//                          say that positions change by velocities
// Units    : those of A and v
// Shape    : square A, for TimeStep without an eigenvalue of zero
// Errors   : none
// Accuracy : rounding; no error of the step's length (tests/dynamics/motion_test.cpp)
// Source   : Franklin, Powell, Workman, Digital Control of Dynamic Systems, chapter 6
#pragma once

#include <Eigen/Core>

namespace frustum::dynamics {

class TimeStep {
 public:
  TimeStep(const Eigen::MatrixXd& matrix, double seconds);

  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& state,
                                           const Eigen::VectorXd& input_before,
                                           const Eigen::VectorXd& input_after) const {
    return transition_ * state + before_ * input_before + after_ * input_after;
  }

 private:
  Eigen::MatrixXd transition_;
  Eigen::MatrixXd before_;
  Eigen::MatrixXd after_;
};

class SeriesStep {
 public:
  // The first `positions` rows are rate times the next ones.
  SeriesStep(const Eigen::MatrixXd& matrix, Eigen::Index positions, double seconds);

  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& state,
                                           const Eigen::VectorXd& input_before,
                                           const Eigen::VectorXd& input_after) const;

 private:
  // Of the state, per step.
  void change(const Eigen::VectorXd& state, Eigen::VectorXd& rate) const;

  Eigen::Index positions_;
  double seconds_;
  double rate_;
  Eigen::MatrixXd below_;
};

}  // namespace frustum::dynamics

// The step that makes the largest of many linear functions least, within a box.
//
// Model    : minimise h over (t, h) with v_i + g_i.t <= h (high side), -(v_i + g_i.t) <= h (low
//            side) and |t_j| <= reach_j; a dual simplex that always knows multipliers >= 0 and adds
//            the worst violator
// Units    : those of the values
// Shape    : m rows, k <= 7 unknowns
// Errors   : LinearMinimax::solved is false when rounding makes the exchange go in circles
// Accuracy : 1e-15 of values of order one
// Source   : Nocedal, Wright, Numerical Optimization, chapter 13 (dual simplex)
#pragma once

#include <Eigen/Core>
#include <vector>

namespace frustum::metrology {

struct Sides {
  bool high = true;
  bool low = true;
};

// A function that reaches the level, from below (sign +1) or, negated, from above (-1).
struct ActiveRow {
  Eigen::Index row = 0;
  double sign = 1.0;
  double multiplier = 0.0;  // all of them add up to 1
};

struct LinearMinimax {
  Eigen::VectorXd step{};
  double level = 0.0;
  std::vector<ActiveRow> active{};
  bool at_bound = false;  // the box holds the step back
  bool solved = false;
};

using Gradients = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[nodiscard]] LinearMinimax linear_minimax(const Eigen::VectorXd& values,
                                           const Gradients& gradients, Sides sides,
                                           const Eigen::VectorXd& reach);

}  // namespace frustum::metrology

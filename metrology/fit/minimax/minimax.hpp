// The element whose largest distance is least, near a start, with the proof that nothing near is
// better.
//
// Model    : minimise h = max over points of +-d_i (the sides asked for) over parameters of
//            minimax_surface.hpp that move along the columns of `allowed`. Linear programmes within
//            a trust box find the contacts; where they are fewer than unknowns + 1 the curvature of
//            the distances holds the element, and Newton steps on the contacts with the Hessian of
//            the Lagrangian go there. Large sets are solved on few points, to which the worst
//            violators are added until none is left
// Units    : local frame of size one, rad
// Shape    : n points, at most seven unknowns
// Errors   : MinimaxSolution::proven is false where the certificate fails
// Accuracy : level 1e-15 of the part; `gap` bounds what an element as near as the size of the part
//            could gain, to first order
// Source   : Nocedal, Wright, Numerical Optimization, section 18.5 (sequential linear-quadratic
//            programmes)
#pragma once

#include <span>
#include <vector>

#include "metrology/fit/minimax/linear_minimax.hpp"
#include "metrology/fit/minimax/minimax_surface.hpp"

namespace frustum::metrology {

struct MinimaxProblem {
  Surface surface = Surface::straight;
  Sides sides{};
  SurfaceSteps allowed{};
  // Distances that differ by less tie: they prove a minimum together, to within this.
  double tie = 5e-12;
};

struct MinimaxSolution {
  SurfaceParameters at = SurfaceParameters::Zero();
  double level = 0.0;
  std::vector<ActiveRow> contacts{};  // rows are points
  double imbalance = 0.0;
  double gap = 0.0;
  bool proven = false;  // positive multipliers, balance and curvature
  int iterations = 0;
};

// Of the sides asked for, the largest.
[[nodiscard]] double level_of(const Eigen::VectorXd& distances, Sides sides);

// Steps of `allowed` that change distances by one, root mean square, and independently of each
// other.
[[nodiscard]] SurfaceSteps even_steps(const MinimaxProblem& problem, const SurfaceParameters& at,
                                      std::span<const Vec3> points);

// All points at once: for few of them.
[[nodiscard]] MinimaxSolution minimax_near(const MinimaxProblem& problem,
                                           std::span<const Vec3> points,
                                           const SurfaceParameters& start);

// By exchange. `working` are the points to begin with; those that had to be added stay there for
// the next start. Gives up, unproven, as soon as the level is above `worth`.
[[nodiscard]] MinimaxSolution minimax_near(const MinimaxProblem& problem,
                                           std::span<const Vec3> points,
                                           const SurfaceParameters& start,
                                           std::vector<std::size_t>& working, double worth);

}  // namespace frustum::metrology

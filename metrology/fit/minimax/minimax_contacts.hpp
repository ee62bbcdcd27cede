// Contacts of an element with the bounds of its zone: the step that keeps them, and what they
// prove.
//
// Model    : contacts A with s_i d_i = h. The step solves [H 0 A^T; 0 0 -1; A -1 0] (t, h, lambda),
//            with H the Hessian of sum lambda_i s_i d_i. They prove a minimum when all lambda_i >
//            0, the gradients balance, sum lambda_i s_i grad d_i = 0, and H bends upward along what
//            the contacts leave free
// Units    : local frame of size one, rad
// Shape    : at most unknowns + 1 contacts, or all that tie
// Errors   : no step where the equations are singular; where H bends downward it is made to bend
//            upward
// Accuracy : contacts agree to 1e-15
// Source   : Nocedal, Wright, Numerical Optimization, theorem 12.6 and section 18.1
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "metrology/fit/minimax/minimax.hpp"

namespace frustum::metrology {

// In steps of `basis`.
[[nodiscard]] std::optional<Eigen::VectorXd> contact_step(const MinimaxProblem& problem,
                                                          std::span<const Vec3> points,
                                                          const SurfaceSteps& basis,
                                                          const SurfaceParameters& at,
                                                          const std::vector<ActiveRow>& contacts);

// Newton steps from `at`, whose level over all points is `level`, to where the contacts agree; then
// the proof.
[[nodiscard]] MinimaxSolution settled_on_contacts(const MinimaxProblem& problem,
                                                  std::span<const Vec3> points,
                                                  const SurfaceSteps& basis,
                                                  const SurfaceParameters& at, double level,
                                                  const std::vector<ActiveRow>& contacts);

}  // namespace frustum::metrology

// Levenberg-Marquardt descent, then Gauss-Newton steps down to rounding, within constraints.
//
// Model    : minimise sum w_i d_i^2 over the steps that the constraints allow. A step comes from
//            the normal equations, as long as their condition leaves its direction good digits;
//            else from the QR factors of the Jacobian. What the steps converge to is exact either
//            way: where the gradient of the residuals as computed is zero. Where residuals are so
//            large that such a place may be a saddle or a maximum, Newton's steps with the second
//            derivatives (curvature.hpp) lead on to a minimum
// Units    : local frame of size one (normalised_points.hpp), rad
// Shape    : circle, sphere, cylinder, cone, torus (planes and lines have closed forms); no
//            allocation in a descent
// Errors   : Minimum::converged and Minimum::well_posed tell; the caller words the diagnostic
// Accuracy : the last step is below 1e-10 of the size of the part, typically 1e-15
// Source   : Nocedal, Wright, Numerical Optimization, sections 3.4, 10.2 and 10.3
#pragma once

#include <Eigen/Core>
#include <vector>

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/element_gram.hpp"
#include "metrology/fit/point_blocks.hpp"

namespace frustum::metrology {

struct Minimum {
  Element element{};
  std::vector<double> residuals{};
  Eigen::MatrixXd cofactor{};  // of all parameters; zeros where constraints fix them
  int iterations = 0;
  int free_parameters = 0;
  double condition = 1.0;
  bool converged = false;
  bool well_posed =
      false;  // the points tell every free parameter: the sum of squares bends up in all
};

class GaussNewton {
 public:
  // Points and constraints outlive this.
  GaussNewton(const Element& start, const PointBlocks& points, const Constraints& constraints);

  [[nodiscard]] const Element& element() const { return element_; }
  [[nodiscard]] double cost() const { return cost_of(gram_); }

  // Steps that lower the cost, at most `most`; stops when they lower it by less than `least_gain`
  // of it.
  void descend(int most, double least_gain);
  // Full steps until they no longer shrink, at a minimum.
  [[nodiscard]] Minimum settle();

 private:
  using Square =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostParameters, kMostParameters>;

  // Directions in which the sum of squares bends on its own, and how it does.
  struct Bend {
    Square frame{};  // columns: steps of the free parameters that change the residuals by 1
    ElementStep curvature{};  // least first; 1 where residuals do not bend
    ElementStep downhill{};   // minus the first derivatives
  };

  [[nodiscard]] Element moved_by(const ElementStep& free) const;
  void accept(const Element& element, const ElementGram& gram);
  void reduce();
  [[nodiscard]] ElementStep step(double damping) const;
  [[nodiscard]] ElementStep step_by_factors() const;
  [[nodiscard]] Eigen::MatrixXd rows() const;
  [[nodiscard]] double condition() const;
  [[nodiscard]] bool converged_by_full_steps(bool by_factors);
  // gauss_newton_bend.cpp
  [[nodiscard]] bool may_bend_down(double condition) const;
  [[nodiscard]] bool bends_down() const;
  [[nodiscard]] Bend bend() const;
  [[nodiscard]] bool lowered_by(const ElementStep& step);
  [[nodiscard]] bool left_along(const ElementStep& direction);
  void settle_by_bend(Minimum& result);
  [[nodiscard]] Square root_of_cofactor(Minimum& result) const;
  void report(Minimum& result) const;

  const PointBlocks* points_;
  const Constraints* constraints_;
  bool bound_;
  Element element_;
  int iterations_ = 0;
  ElementGram gram_{};
  StepBasis basis_{};
  // Of the free parameters, each scaled so that its column of the Jacobian has length one.
  Square normal_{};
  ElementStep right_{};
  ElementStep length_{};
};

}  // namespace frustum::metrology

// Standard uncertainties of characteristics from the accuracy of a CMM, by linear propagation.
//
// Model    : every point has the standard deviation p = e0/2 along its normal; the machine's linear
//            field has three scale and three squareness terms of standard deviation s = 1/(2 k).
//            A probe that is stated beside a linear field adds its mean squares to p^2;
//            temperatures add twice the variance of the growth of all lengths to s^2, and what is
//            not compensated counts whole With the cofactors Q of the fits:
//              form (peak to valley)  u^2 = 2 p^2 + 3 (s r)^2: two points count; an ellipse
//              straightness           u^2 = 4 p^2: twice one point
//              half angle a           u^2 = p^2 Q_aa + 1.5 (s sin(2a)/2)^2
//              radius                 u^2 = p^2 g^T Q g + (s r)^2/2; a cone's without what the
//                                     datum system adds to the place of its section
//              concentricity          u^2 = 4 (p^2 (Q_1 + Q_2 + h^2 Q_t) + (s h)^2)
//              ... to a datum         u^2 = 4 (p^2 (Q_1 + Q_d + h^2 Q_t) + (s h)^2)
//              perpendicularity       u^2 = L^2 (p^2 (Q_t1 + Q_t2) + s^2)
//              lines and their frames  influence.hpp
//            g: gradient to the fit's parameters; h: between the sections, or from the datum's
//            middle;
//            L: extent; Q_1, Q_2: larger variance of a section's centre; Q_d: of the datum's axis
//            in its middle; Q_t: larger variance of a tilt
// Units    : mm, rad
// Shape    : closed formulas
// Errors   : none
// Accuracy : first order and on the safe side for forms, whose points share in the fit; the bias
//            that noise gives to a peak-to-valley value is not part of it
// Source   : JCGM 100:2008, section 5.1.2
#pragma once

#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

struct PointUncertainty {
  double probing = 0.0;  // mm, p above
  double scale = 0.0;    // relative, s above

  // Of a machine that has no errors, or of which nothing is known.
  [[nodiscard]] bool is_zero() const { return probing == 0.0 && scale == 0.0; }
};
[[nodiscard]] PointUncertainty point_uncertainty(const CmmModel& cmm);

[[nodiscard]] double form_uncertainty(const PointUncertainty& u, double radius);
[[nodiscard]] double straightness_uncertainty(const PointUncertainty& u);
[[nodiscard]] double half_angle_uncertainty(const PointUncertainty& u, const FittedFeature& cone);
// `along`: where on the axis the radius is wanted, from the element's point.
[[nodiscard]] double radius_uncertainty(const PointUncertainty& u, const FittedFeature& feature,
                                        double along);
[[nodiscard]] double concentricity_uncertainty(const PointUncertainty& u, const Fit<Circle>& first,
                                               const Fit<Circle>& second,
                                               const FittedFeature& axis);
[[nodiscard]] double concentricity_uncertainty(const PointUncertainty& u,
                                               const Fit<Circle>& section,
                                               const FittedFeature& datum);
[[nodiscard]] double perpendicularity_uncertainty(const PointUncertainty& u,
                                                  const FittedFeature& toleranced,
                                                  const FittedFeature& datum, double extent);

// Of twice the distance of a point of the feature's element, `away` mm from its middle.
[[nodiscard]] double place_uncertainty(const PointUncertainty& u, const FittedFeature& feature,
                                       double away);

}  // namespace frustum::metrology

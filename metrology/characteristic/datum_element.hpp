// The ideal element that represents a measured feature by a criterion of the plan's choice.
//
// Model    : least_squares without constraints is the element that the feature was fitted with;
//            others are associated with its points anew (association.hpp). outside_material knows
//            the plan's normal of a plane or line and the side of a hole. Axes agree with the plan
// Units    : mm, rad
// Shape    : one feature
// Errors   : those of the association, with the feature's name
// Accuracy : that of the association
// Source   : ISO 5459, ISO 1101:2017
#pragma once

#include <span>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/fit/association.hpp"

namespace frustum::metrology {

[[nodiscard]] Result<Association> associated(const FittedFeature& feature, Criterion criterion,
                                             const Constraints& constraints = {});
[[nodiscard]] Result<Element> datum_element(const FittedFeature& feature, Criterion criterion,
                                            const Constraints& constraints = {});

// The axis that one datum feature or several have in common: of several the least-squares line
// through the centres of their sections.
[[nodiscard]] Result<Line> common_axis(std::span<const FittedFeature* const> datums,
                                       Criterion criterion);

}  // namespace frustum::metrology

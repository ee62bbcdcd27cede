// Constraints of an association as a basis of the steps that an element may still make.
//
// Model  : an element that keeps the constraints, moved by basis * coefficients, keeps them again:
//          fixed directions exactly, to rounding. The basis belongs to the element's own tangents:
//          ask again after every move
// Units  : mm, rad
// Shape  : orthonormal columns, one a degree of freedom left; none when everything is fixed
// Errors : constraints that the kind does not have, that contradict each other, or that are no
//          numbers
#pragma once

#include <optional>
#include <string_view>

#include "core/diagnostic.hpp"
#include "metrology/fit/constraints.hpp"
#include "metrology/fit/element_model.hpp"

namespace frustum::metrology {

using StepBasis =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostParameters, kMostParameters>;

// Nothing when elements of the kind can keep them. `what` names the element in the diagnostic.
[[nodiscard]] std::optional<Diagnostic> refused(const Constraints& constraints, ElementKind kind,
                                                std::string_view what);

// Of constraints that are not refused, for an element that keeps them.
[[nodiscard]] StepBasis allowed_steps(const Element& element, const Constraints& constraints);

// The element changed as little as needed to keep them; its axis keeps its sense.
[[nodiscard]] Element constrained(const Element& element, const Constraints& constraints);

}  // namespace frustum::metrology

// How far a point of a finished part lies from the surface that its inspection plan asks for.
//
// Model    : signed orthogonal distance from the nominal surface of the planned feature that owns
//            the point: inside its extent, normals within 20 deg, nearer than 1 mm; the nearest
//            such feature
// Units    : mm; point and normal in the workpiece frame of the plan
// Shape    : one point a call, no allocation
// Errors   : nothing is returned when no feature owns the point
// Accuracy : rounding of doubles
// Source   : element.hpp
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/fit/nominal_surface.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// `normal` points out of the material; so does positive deviation (material left standing).
[[nodiscard]] std::optional<double> deviation_from_nominal(const InspectionPlan& plan,
                                                           const Vec3& point, const Vec3& normal);

// The nominal surface of a feature that has an element; of a point the plane it is on. Its
// outward side is that of the geometry, not of the material.
[[nodiscard]] Element nominal_element(const PlannedFeature& feature);
// +1 when the material's outward normal is the element's, -1 for a hole.
[[nodiscard]] double material_sign(const PlannedFeature& feature);

// The surface that a feature is of: that of a line is the plane through it that its normal gives.
[[nodiscard]] NominalSurface planned_surface(const PlannedFeature& planned);

}  // namespace frustum::metrology

// Whether measured points are of the size that a plan expects.
//
// Model    : what the points of all features span against what the plan's own points of these
//            features span. A ratio near 25.4 or 1000, or near the inverse of either, tells of a
//            unit, not of a part
// Units    : mm
// Shape    : all features at once; a body by its bounding box, which holds more than what is probed
// Errors   : the fault names the likely unit and how to state it
// Accuracy : ratios within 1.5 of a unit's
// Source   : ours
#pragma once

#include <optional>
#include <span>

#include "core/diagnostic.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/points/feature_points.hpp"

namespace frustum::metrology {

[[nodiscard]] std::optional<Diagnostic> scale_fault(const InspectionPlan& plan,
                                                    std::span<const FeaturePoints> features);

// A body that is to be probed by the plan, by its corners: it must be as large as what is probed.
[[nodiscard]] std::optional<Diagnostic> scale_fault(const InspectionPlan& plan,
                                                    std::span<const Vec3> body);

}  // namespace frustum::metrology

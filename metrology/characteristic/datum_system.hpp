// Where the datum system of a part sits: six degrees of freedom, taken by datums in their order.
//
// Model    : a datum gives a direction (normal of a plane; axis of a cylinder, cone or line), a
//            place and the directions in which it holds that place (a plane and a touch: its
//            normal; a line: the normal of its surface across it; an axis and a circle: across; a
//            cone also along, at its planned radius; a sphere: all). The first direction is laid
//            onto the planned one; the second, or the line from the first held place to a later
//            one, is laid into the plane across the first. Then each datum in turn holds its place
//            in the planned direction, as far as those before it have left that free. Planes,
//            cylinders and cones after the first are fitted with the direction that those before
//            them give, as far as they do. An axis
//            across a primary plane is held where it pierces that plane, all else at the middle of
//            its points. Rotation about the first direction that no datum takes keeps workpiece Y
//            (X where Y stands nearly upright) in the plane of both directions; other degrees left
//            keep their planned value
// Units    : mm, rad
// Shape    : one system; workpiece_from_datum is the identity for a perfect part
// Errors   : a datum without points; a best fit that does not settle
// Accuracy : rounding of doubles (tests/metrology/datum_system_test.cpp)
// Source   : ISO 5459 (order of precedence, situation features); Bossoni 2010, appendix A.4.1 for
//            plane, cylinder, groove
#pragma once

#include <span>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/plan/datum_precedence.hpp"

namespace frustum::metrology {

// `features` are in the workpiece frame; the system is one that check() accepts.
[[nodiscard]] Result<FoundDatum> found_datum(const DatumSystem& system,
                                             std::span<const FittedFeature> features);

// True when results of this plan refer to measured datum features.
[[nodiscard]] bool uses_datum(const InspectionPlan& plan);
[[nodiscard]] bool is_datum_feature(const InspectionPlan& plan, const PlannedFeature& feature);

// workpiece_from_datum; the identity for a plan without datum system.
[[nodiscard]] Result<Pose> alignment_of(const InspectionPlan& plan,
                                        std::span<const FittedFeature> features);

}  // namespace frustum::metrology

// The frame that floors and a wall of a part span, as a plan's [[frame]] asks.
//
// Model    : Z = outward normal of the least-squares plane through all points of `planes`; X = the
//            line, shifted to its planned height over that plane (best_shifted_line.hpp) and laid
//            into it; the origin keeps the planned height over the plane and the planned distance
//            from the line, and its planned place along the line, which no feature tells.
//            workpiece_from_frame = measured times inverse of nominal: the identity for a perfect
//            part
// Units    : mm, rad
// Shape    : one frame
// Errors   : a feature without points; points that do not tell the plane or the line
// Accuracy : rounding of doubles (tests/metrology/workpiece_frame_test.cpp)
// Source   : Ibaraki et al. 2010, section 3: workpiece coordinates from the reference step
#pragma once

#include <span>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// The planned frame: origin at the planned point of the line, axes as above.
[[nodiscard]] Pose nominal_frame(const InspectionPlan& plan, const PlannedFrame& frame);

// `features` are in the workpiece frame; the plan is one that check() accepts.
[[nodiscard]] Result<Pose> workpiece_from_frame(const InspectionPlan& plan,
                                                const PlannedFrame& frame,
                                                std::span<const FittedFeature> features);

}  // namespace frustum::metrology

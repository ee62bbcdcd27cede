// Whether what was measured is what the program meant to cut.
//
// Model    : a feature that an operation makes must have been cut, at every measured point, by the lines of
//            that operation; elsewhere the blank shows through, or another pass has cut deeper
// Units    : mm
// Errors   : none; features that were not measured are passed over
// Accuracy : exact
// Source   : ours
#pragma once

#include "core/diagnostic.hpp"
#include "metrology/measurement.hpp"
#include "programs/test_piece.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

// One warning for each feature with points that its operation did not make.
[[nodiscard]] Diagnostics wrongly_cut_features(const programs::TestPiece& piece,
                                               const stock::Workpiece& workpiece,
                                               const metrology::Measurement& measurement);

// The surface at a measured point, asked along its normal; nothing when there is none within reach.
[[nodiscard]] std::optional<stock::SurfacePoint> surface_at_point(const stock::Workpiece& workpiece,
                                                                  const Vec3& point,
                                                                  const Vec3& normal);
// How far from the point surface_at_point() looks, to either side, mm.
inline constexpr double kSurfaceSearch = 0.05;

}  // namespace frustum::trials

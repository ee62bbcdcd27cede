// The body that a tool off its spindle axis sweeps as it turns.
//
// Model    : the tool's axis is `offset` beside the spindle axis: every circle of radius r about
//            the tool's axis covers the ring from |offset - r| to offset + r about the spindle's.
//            The generatrix moves outwards, a recess narrows, a point becomes a ring around a
//            dimple. `tilt`: the offset falls by tilt z up the axis; the generatrix turns about its
//            rim, so that the wobble of an end face (radius times tilt) and terms in tilt^2 are
//            left out
// Units    : mm, rad
// Errors   : an offset as large as the tool's radius
// Accuracy : within 1e-8 mm without tilt: a dimple shallower than that is filled
#pragma once

#include <vector>

#include "core/result.hpp"
#include "cutter/body/generatrix.hpp"

namespace frustum::cutter {

[[nodiscard]] Result<std::vector<GeneratrixSegment>> with_run_out(
    const std::vector<GeneratrixSegment>& chain, double offset, double tilt);
// Every point farther from the axis by `by`, or nearer; a face of the radius `by` fills the middle.
[[nodiscard]] std::vector<GeneratrixSegment> widened(const std::vector<GeneratrixSegment>& chain,
                                                     double by);

}  // namespace frustum::cutter

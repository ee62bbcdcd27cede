// Orientation errors written for other reference axes than the machine's.
//
// Model    : ISO 230-1 gives the primary reference axis no orientation error and the secondary one
//            only its squareness to it: the choice fixes the frame of the bed. Restating turns that
//            frame by the small rotation w that makes the machine's choice true; linear axes and
//            the first rotary axis of either chain take w as orientation error, and w x offset as
//            position error
// Units    : mm, rad
// Errors   : the machine names no two reference axes, they are not square or ride on a rotary axis,
//            tilts that carry, an axis turning about the tip with other axes behind it
// Accuracy : first order; a tool (or table) with no rotary axis behind it keeps its attitude to the
//            bed, which differs by a constant turn (tests/kinematics/reference_axes_test.cpp)
// Source   : ISO 230-1, reference axes; a rigid turn of the whole machine
#pragma once

#include "core/result.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// The same machine's errors, stated for its own reference axes.
[[nodiscard]] Result<GeometricErrors> restated(const Machine& machine,
                                               const GeometricErrors& errors);

}  // namespace frustum::kinematics

// The blank that a body is cut from when little is left on its faces.
//
// Model    : every face of the body moved outward by the allowance, perpendicular to it; the bottom
//            stays
// Units    : mm; frame: of the loft
// Shape    : two sections for each tier of the body, in its order
// Errors   : none; a body that Blank::make takes gives a blank that it takes, as long as ledges of
//            the body are wider and levels higher than the allowance
// Accuracy : rounded to a nanometre
// Source   : ours
#pragma once

#include "stock/solid/blank.hpp"

namespace frustum::programs {

[[nodiscard]] stock::LoftShape near_net_blank(const stock::LoftShape& body, double allowance);

}  // namespace frustum::programs

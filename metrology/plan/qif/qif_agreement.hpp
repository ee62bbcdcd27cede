// Whether an attribute of a QIF document says what its elements say, beyond the digits that
// elements have.
//
// Units  : mm and rad
// Errors : none
#pragma once

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// What differs; null where nothing does. `stated` is what elements say; the place of a cylinder or
// line counts across its axis only, as elements have it at an end.
[[nodiscard]] const char* disagreement(const PlannedFeature& stated, const PlannedFeature& read);
[[nodiscard]] const char* disagreement(const PlannedCharacteristic& stated,
                                       const PlannedCharacteristic& read);

}  // namespace frustum::metrology

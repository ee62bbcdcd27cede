// Why no element within constraints fits: what the points ask for instead.
//
// Units  : mm, rad; the frame of the points. Half angles are reported in degrees
// Errors : none; the answer is the diagnostic, or nothing when the free element nearly keeps them
#pragma once

#include <optional>
#include <string_view>

#include "core/diagnostic.hpp"
#include "metrology/fit/constraints.hpp"

namespace frustum::metrology {

// `free` is the fit without constraints, `what` the name of the element in the diagnostic.
[[nodiscard]] std::optional<Diagnostic> unmet(const Constraints& keep, const Element& free,
                                              std::string_view what);

}  // namespace frustum::metrology

// Whether what a descent ran to is an element at all, or the sign that the points belong to another
// kind.
//
// Units  : local frame of size one (normalised_points.hpp), rad
// Errors : none; the answer is the reason, or nothing
#pragma once

#include <optional>
#include <string>

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

[[nodiscard]] std::optional<std::string> implausible(const Element& element);

}  // namespace frustum::metrology

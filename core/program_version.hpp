// The version of Frustum that this is: "0.1.0". Every JSON document states it beside its schema.
//
// Units  : none
// Errors : none
#pragma once

#include <string_view>

namespace frustum {

[[nodiscard]] std::string_view program_version();

}  // namespace frustum

// A number with what it counts: "1 run", "3 runs".
//
// Units: none. Errors: none.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace frustum {

// `many`: the plural where it is not `one` with an s ("vertices").
[[nodiscard]] std::string counted(std::size_t number, std::string_view one,
                                  std::string_view many = {});

}  // namespace frustum

// Numbers in one word, as in --center x,y,z.
//
// Units: those of the caller. Errors: a part that is no number, one beyond 1e9,
// another count.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

// "x,y,z" (n numbers), or a diagnostic that says what was expected.
[[nodiscard]] Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count,
                                                     const std::string& what);
// "0,30,60": as many as there are.
[[nodiscard]] Result<std::vector<double>> number_list(const std::string& text,
                                                      const std::string& what);

}  // namespace frustum::app

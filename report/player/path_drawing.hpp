// The tool path as a still drawing, for paper and for browsers without a script.
//
// Units: mm. Errors: none; a path without points gives an empty drawing.
#pragma once

#include <string>

#include "report/player/player_page.hpp"

namespace frustum::report {

// The error-free tips, seen obliquely; rapids thin.
[[nodiscard]] std::string path_drawing(const PlayerPage& page);

}  // namespace frustum::report

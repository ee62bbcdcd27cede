// What made a point of a workpiece's surface: the answer of a probe keeps it, so that nobody asks
// the workpiece again to find out what was touched.
//
// Units  : mm; the time as a fraction of the path segment
// Errors : none
#pragma once

#include <cstdint>
#include <optional>

namespace frustum {

struct Provenance {
  std::optional<std::uint32_t> segment{};  // of the tool path; nothing: the blank's own surface
  std::uint32_t source_line = 0;           // NC line that cut it; 0: the blank
  double t = 0.0;                          // when on the path segment, 0..1
  double sweep_bound = 0.0;  // mm, from what this tool path leaves: solution and rounding
  double bound = 0.0;  // mm, from what the commanded motion leaves: the path's own bound added
};

}  // namespace frustum

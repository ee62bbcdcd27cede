// Control points of an S-shaped piece from a file, of those who own other ones.
//
// Units  : mm
// Errors : lines that are not curve,x,y,z, unknown curves, curves that are missing, with another
//          number of points or not level, each with file, line and column
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "programs/s_piece/s_piece.hpp"

namespace frustum::programs {

// CSV with the header curve,x,y,z: C0 and C1 of flank A, D0 and D1 of a flank B of its own.
[[nodiscard]] Result<ControlPoints> read_control_points(const std::filesystem::path& file);
[[nodiscard]] Result<ControlPoints> parse_control_points(std::string_view text,
                                                         const std::filesystem::path& file = {});

}  // namespace frustum::programs

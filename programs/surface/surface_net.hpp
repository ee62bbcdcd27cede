// A net of control points from a file.
//
// Units  : mm
// Errors : lines that are not row,x,y,z, rows of another length, fewer than two rows or columns,
//          each with file, line and column
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"
#include "core/spline_surface.hpp"

namespace frustum::programs {

// CSV with the header row,x,y,z: the points of each row in order, rows 0, 1, 2, ... one after the
// other.
[[nodiscard]] Result<SplineSurface> read_surface_net(const std::filesystem::path& file);
[[nodiscard]] Result<SplineSurface> parse_surface_net(std::string_view text,
                                                      const std::filesystem::path& file = {});

}  // namespace frustum::programs

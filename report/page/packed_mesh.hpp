// A triangle mesh as JSON for the page: positions on a grid over its longest side, packed.
//
// Units: as the mesh, mm. Errors: none; precondition: at least one vertex.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace frustum::report {

// Steps of the grid over the longest side of the bounding box. Half a micrometre for a workpiece of
// 100 mm; a pixel of a large screen needs no more than 2^15.
inline constexpr double kFineGrid = 262143.0;
inline constexpr double kPictureGrid = 32767.0;

// vertices, triangles, origin, step, positions, corners (report/page/surface.js reads them).
[[nodiscard]] nlohmann::ordered_json packed_mesh(
    std::span<const std::array<float, 3>> vertices,
    std::span<const std::array<std::uint32_t, 3>> triangles, double grid);

}  // namespace frustum::report

// A triangle mesh for the page: positions on a grid over its longest side, packed.
//
// Units: as the mesh, mm. Errors: none; precondition: at least one vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace frustum::report {

// Steps of the grid over the longest side of the bounding box. Half a micrometre for a workpiece of
// 100 mm; a pixel of a large screen needs no more than 2^15.
inline constexpr double kFineGrid = 262143.0;
inline constexpr double kPictureGrid = 32767.0;

struct PackedMesh {
  std::size_t vertices = 0, triangles = 0;
  std::array<float, 3> origin{};
  double step = 0.0;  // of the grid
  std::string positions{}, corners{};
};
[[nodiscard]] PackedMesh packed_mesh(std::span<const std::array<float, 3>> vertices,
                                     std::span<const std::array<std::uint32_t, 3>> triangles,
                                     double grid);

// As report/page/surface.js and report/player/machine.js read it.
template <typename Json>
[[nodiscard]] Json json_of(const PackedMesh& mesh) {
  return {{"vertices", mesh.vertices}, {"triangles", mesh.triangles}, {"origin", mesh.origin},
          {"step", mesh.step},         {"positions", mesh.positions}, {"corners", mesh.corners}};
}

}  // namespace frustum::report

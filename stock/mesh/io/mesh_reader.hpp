// Triangle meshes out of files that other programs write: STL, PLY, OBJ.
//
// STL binary or text, PLY text or binary of either byte order, OBJ. Corners of an STL that agree to
// the last bit become one vertex; polygons are split into fans of triangles; triangles that name a
// vertex twice are left out. Only vertices and triangles are read.
// Units: mm, as the numbers are (none of the formats says its unit).
// Errors: a file that cannot be read, that is cut short or malformed (with line or byte), whose
//         numbers are not finite, or that has no triangles; a format that is only written (3MF,
//         VTP).
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"
#include "stock/mesh/io/mesh_file.hpp"

namespace frustum::stock {

[[nodiscard]] Result<SurfaceMesh> read_mesh(const std::filesystem::path& file);
// The same for the bytes of a file; diagnostics name no file.
[[nodiscard]] Result<SurfaceMesh> parse_mesh(std::string_view bytes, MeshFormat format);

}  // namespace frustum::stock

// Surface meshes as files that other programs open: STL, PLY, OBJ, 3MF, VTP.
//
// STL is binary, single precision, no per-vertex data. PLY is binary little endian: x y z as
// double, nx ny nz, deviation_um, quality (the same number, under the name by which viewers colour)
// as float, and uchar has_nominal (0: no nominal at this vertex, its deviation says 0); of a mesh
// without normals and deviations x y z alone. OBJ is text
// with normals. 3MF is one object in millimetres. VTP (ParaView) has points as double, normals,
// deviation_um (not a number where there is no nominal: drawn in the colour for that) and kind
// (VertexKind) at every point.
// Units: mm; deviations in micrometres (PLY and VTP only).
// Errors: an extension other than .stl .ply .obj .3mf .vtp, a path that cannot be written, a 3MF
//         beyond the 4 GiB of its archive. The file appears whole or not at all: an existing file
//         is untouched until the new one is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

enum class MeshFormat { stl, ply, obj, three_mf, vtp };

// By the extension, upper or lower case.
[[nodiscard]] Result<MeshFormat> mesh_format_of(const std::filesystem::path& file);

// The bytes of the file.
[[nodiscard]] std::string mesh_bytes(const SurfaceMesh& mesh, MeshFormat format);

// Writes the mesh in the format of the extension; returns the size of the file in bytes.
[[nodiscard]] Result<std::uintmax_t> write_mesh(const SurfaceMesh& mesh,
                                                const std::filesystem::path& file);

}  // namespace frustum::stock

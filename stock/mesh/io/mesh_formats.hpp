// The readers of the mesh formats, one a source; stock/mesh/io/mesh_reader.hpp chooses among them.
//
// Units: mm, as the numbers are. Errors: bytes that are cut short or malformed, with line or byte;
// diagnostics name no file. A mesh without triangles is no error here.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] Result<SurfaceMesh> parse_stl(std::string_view bytes);
[[nodiscard]] Result<SurfaceMesh> parse_ply(std::string_view bytes);
[[nodiscard]] Result<SurfaceMesh> parse_obj(std::string_view text);

// A fan of triangles; those that name a corner twice are left out.
void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners);

[[nodiscard]] Diagnostic mesh_fault(DiagnosticId id, int line, std::string message,
                                    std::string hint = {});
// Where a number, such as "a finite coordinate", should be.
[[nodiscard]] Diagnostic not_a_number(int line, std::string_view word, std::string_view what);

}  // namespace frustum::stock

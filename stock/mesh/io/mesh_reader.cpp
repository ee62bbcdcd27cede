#include "stock/mesh/io/mesh_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "core/whole_file.hpp"
#include "stock/mesh/io/mesh_formats.hpp"

namespace frustum::stock {
namespace {

constexpr const char* kReadable = "convert the mesh to .stl, .ply or .obj";

}  // namespace

Diagnostic mesh_fault(DiagnosticId id, int line, std::string message, std::string hint) {
  Diagnostic found = error(id, std::move(message), std::move(hint));
  found.line = line;
  return found;
}

Diagnostic not_a_number(int line, std::string_view word, std::string_view what) {
  if (word.empty()) {
    return mesh_fault("file-cut-short"_id, line,
                      fmt::format("the file ends where {} should be", what));
  }
  return mesh_fault("number-expected"_id, line,
                    fmt::format("'{}' is not {}", word.substr(0, 40), what));
}

void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::array<std::uint32_t, 3> t{corners[0], corners[k - 1], corners[k]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }
}

Result<SurfaceMesh> parse_mesh(std::string_view bytes, MeshFormat format) {
  Result<SurfaceMesh> mesh =
      error("mesh-format"_id, "3MF and VTP files are written here, not read", kReadable);
  if (format == MeshFormat::stl) mesh = parse_stl(bytes);
  if (format == MeshFormat::ply) mesh = parse_ply(bytes);
  if (format == MeshFormat::obj) mesh = parse_obj(bytes);
  if (mesh && mesh->triangles.empty()) return error("mesh-empty"_id, "the file has no triangles");
  return mesh;
}

Result<SurfaceMesh> read_mesh(const std::filesystem::path& file) {
  const auto format = mesh_format_of(file);
  if (!format) {
    Diagnostic unknown = format.error().front();
    unknown.hint = kReadable;
    return unknown;
  }
  const auto named = [&](Diagnostic fault) {
    fault.file = file.string();
    return fault;
  };
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    return named(error("file-unreadable"_id, "this is a directory, not a mesh",
                       "name one of the files in it"));
  }
  const auto bytes = read_whole_file(file);
  if (!bytes) {
    return named(
        error("file-unreadable"_id, "the mesh cannot be read", "check the path and permissions"));
  }
  auto mesh = parse_mesh(*bytes, *format);
  if (!mesh) return named(mesh.error().front());
  return mesh;
}

}  // namespace frustum::stock

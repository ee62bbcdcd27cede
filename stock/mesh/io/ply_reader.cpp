#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "core/ply.hpp"
#include "stock/mesh/io/mesh_formats.hpp"

namespace frustum::stock {
namespace {

std::optional<Diagnostic> read_ply_vertices(PlyBody& body, const PlyElement& element,
                                            SurfaceMesh& mesh) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name(1, static_cast<char>('x' + k));
    const auto column = element.value_column(name);
    if (!column) {
      return error("ply-property"_id,
                   fmt::format("the vertices of the PLY have no property {}", name),
                   "a vertex needs x, y and z");
    }
    columns[k] = *column;
  }
  PlyRow row;
  for (std::size_t v = 0; v < element.count; ++v) {
    if (auto fault = body.read(element, v, row)) return fault;
    const Vec3 point(row.values[columns[0]], row.values[columns[1]], row.values[columns[2]]);
    if (!point.allFinite()) {
      return body.fault("coordinate-not-finite"_id, "a coordinate that is not finite");
    }
    mesh.vertices.push_back(point);
  }
  return std::nullopt;
}

std::optional<Diagnostic> read_ply_faces(PlyBody& body, const PlyElement& element,
                                         SurfaceMesh& mesh) {
  auto column = element.list_column("vertex_indices");
  if (!column) column = element.list_column("vertex_index");
  PlyRow row;
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < element.count; ++f) {
    if (auto fault = body.read(element, f, row)) return fault;
    corners.clear();
    if (column) {
      for (const double index : row.lists[*column]) {
        if (!(index >= 0.0 && index < static_cast<double>(mesh.vertices.size()))) {
          return body.fault("vertex-unknown"_id,
                            fmt::format("face {} names vertex {}; there are {}, counted from 0",
                                        f + 1, index, mesh.vertices.size()));
        }
        corners.push_back(static_cast<std::uint32_t>(index));
      }
    }
    if (corners.size() < 3) {
      return body.fault("facet-corners"_id,
                        fmt::format("face {} has {} corners", f + 1, corners.size()));
    }
    add_polygon(mesh, corners);
  }
  return std::nullopt;
}

}  // namespace

Result<SurfaceMesh> parse_ply(std::string_view bytes) {
  const auto header = read_ply_header(bytes);
  if (!header) return header.error();
  SurfaceMesh mesh;
  PlyBody body(bytes, *header);
  PlyRow ignored;
  for (const PlyElement& element : header->elements) {
    std::optional<Diagnostic> fault;
    if (element.name == "vertex") {
      fault = read_ply_vertices(body, element, mesh);
    } else if (element.name == "face") {
      fault = read_ply_faces(body, element, mesh);
    } else if (!element.properties.empty()) {
      for (std::size_t row = 0; row < element.count && !fault; ++row) {
        fault = body.read(element, row, ignored);
      }
    }
    if (fault) return *fault;
  }
  return mesh;
}

}  // namespace frustum::stock

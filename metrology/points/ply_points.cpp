#include "metrology/points/ply_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/ply.hpp"

namespace frustum::metrology {
namespace {

using Columns = std::array<std::size_t, 3>;  // of x, y and z

Result<Columns> coordinate_columns(const PlyElement& vertex) {
  for (const PlyProperty& p : vertex.properties) {
    if (p.count) return error("ply-vertices"_id, "the vertices of the PLY hold a list");
  }
  Columns columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto column = vertex.value_column(name);
    if (!column) {
      return error("ply-vertices"_id,
                   fmt::format("the vertices of the PLY have no property {}", name),
                   "a point needs x, y and z");
    }
    columns[axis] = *column;
  }
  return columns;
}

Result<std::vector<Vec3>> vertices(PlyBody& body, const PlyElement& element) {
  const auto columns = coordinate_columns(element);
  if (!columns) return columns.error();
  std::vector<Vec3> points;
  PlyRow row;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (auto fault = body.read(element, i, row)) return *std::move(fault);
    const auto [x, y, z] = *columns;
    points.emplace_back(row.values[x], row.values[y], row.values[z]);
    if (!points.back().allFinite()) {
      return body.fault("point-not-finite"_id,
                        fmt::format("vertex {} of the PLY is not finite", i + 1),
                        "leave out points that were not measured");
    }
  }
  return points;
}

}  // namespace

Result<PlyPoints> parse_ply_points(std::string_view bytes) {
  const auto header = read_ply_header(bytes);
  if (!header) return header.error();
  PlyPoints found;
  for (const PlyComment& comment : header->comments) {
    auto unit = stated_unit(comment.text);
    if (!unit) {
      Diagnostic wrong = unit.error().front();
      wrong.line = comment.line;
      return wrong;
    }
    if (*unit) found.unit = **unit;
  }
  PlyBody body(bytes, *header);
  PlyRow row;
  for (const PlyElement& element : header->elements) {
    if (element.name == "vertex") {
      auto points = vertices(body, element);
      if (!points) return std::move(points).error();
      found.points = *std::move(points);
      return found;
    }
    // What comes before the vertices is passed over.
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      if (auto fault = body.read(element, i, row)) return *std::move(fault);
    }
  }
  Diagnostic none =
      error("ply-vertices"_id, "the PLY has no vertices", "a point cloud is its element vertex");
  none.line = header->lines;
  return none;
}

}  // namespace frustum::metrology

// The vertices of a PLY file: a point cloud, or a scan taken as points.
//
// Text, binary little endian and binary big endian; x y z of any number type. Other properties and
// elements are passed over.
// Units  : as the numbers stand; `unit` when a comment of the header states one ("comment unit:
//          inch")
// Errors : a malformed header, a vertex element without x y z, bytes that end too early,
//          coordinates that are not finite; with line, or with the number of the vertex in binary
//          files
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "metrology/points/length_unit.hpp"

namespace frustum::metrology {

struct PlyPoints {
  std::vector<Vec3> points{};
  std::optional<LengthUnit> unit{};
};

// Diagnostics name no file.
[[nodiscard]] Result<PlyPoints> parse_ply_points(std::string_view bytes);

}  // namespace frustum::metrology

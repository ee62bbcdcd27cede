#include "metrology/plan/line_axes.hpp"

namespace frustum::metrology {

std::optional<LineAxes> line_axes(CharacteristicKind kind, const Vec3& line,
                                  const Vec3& direction) {
  const auto along = UnitVec3::of(line);
  if (!along) return std::nullopt;
  const Vec3 u = *along;
  const auto across =
      UnitVec3::of(kind == CharacteristicKind::line_angle ? Vec3(direction.cross(u))
                                                          : Vec3(direction - direction.dot(u) * u));
  if (!across) return std::nullopt;
  return LineAxes{u, *across, u.cross(across->vec())};
}

}  // namespace frustum::metrology

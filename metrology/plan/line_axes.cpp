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

bool is_parallel(const Vec3& a, const Vec3& b) {
  constexpr double kParallel = 1e-6;
  return a.normalized().cross(b.normalized()).norm() <= kParallel;
}

}  // namespace frustum::metrology

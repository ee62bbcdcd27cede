#include <fmt/format.h>

#include <array>

#include "metrology/least_squares.hpp"
#include "metrology/normalised_points.hpp"
#include "metrology/plane_through.hpp"

namespace frustum::metrology {

Result<UnitVec3> plane_normal(const NormalisedPoints& local, std::string_view what) {
  const PrincipalDirections principal = principal_directions(local);
  if (principal.spread[1] < kFlat * principal.spread[0]) {
    return error(fmt::format("degenerate points for a {}: they lie on one straight line", what),
                 "spread the points over the surface");
  }
  // Two spreads that agree to nine digits: rounding, not the points, would choose the normal.
  if (principal.spread[2] > (1.0 - 1e-9) * principal.spread[1]) {
    return error(fmt::format("degenerate points for a {}: no plane stands out", what),
                 "the points spread as much across the plane as along it");
  }
  return canonical(principal.directions.col(2));
}

Result<Fit<Plane>> fit_plane(std::span<const Vec3> points) {
  auto local = normalise(points, "plane", 3);
  if (!local) return std::move(local).error();
  auto normal = plane_normal(*local, "plane");
  if (!normal) return std::move(normal).error();
  const auto [u, v] = tangents(*normal);
  std::vector<double> residuals;
  Mat3 information = Mat3::Zero();
  for (const Vec3& p : local->points) {
    residuals.push_back(p.dot(normal->vec()));
    const Vec3 row(1.0, p.dot(u), p.dot(v));
    information += row * row.transpose();
  }
  constexpr std::array kIsAngle{false, true, true};
  return completed(*local, Plane{local->centre, *normal}, residuals, information.inverse(),
                   kIsAngle, static_cast<double>(points.size()) - 3.0, 0);
}

}  // namespace frustum::metrology

#include "stock/solid/nominal_mesh.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace frustum::stock {

namespace {

// The side of a point whose nearest one is within a facet is that of the facet; at an edge or
// corner the whole mesh says it.
double signed_from(const FacetSolid& nominal, const Vec3& point) {
  const FacetSolid::Nearest foot = nominal.nearest(point);
  const FacetSolid::Facet& facet = nominal.facets()[static_cast<std::size_t>(foot.facet)];
  const Vec3 a = nominal.vertices()[facet[0]], b = nominal.vertices()[facet[1]],
             c = nominal.vertices()[facet[2]];
  const Vec3 across = (b - a).cross(c - a);
  const double area = across.squaredNorm();
  constexpr double kWithin = 1e-6;  // of the facet
  const double to_c = (b - a).cross(foot.point - a).dot(across);
  const double to_a = (c - b).cross(foot.point - b).dot(across);
  const bool is_within =
      to_c > kWithin * area && to_a > kWithin * area && to_a + to_c < (1.0 - kWithin) * area;
  if (!is_within) return nominal.contains(point) ? -foot.distance : foot.distance;
  return (point - foot.point).dot(across) < 0.0 ? -foot.distance : foot.distance;
}

}  // namespace

std::vector<std::optional<double>> deviations_from(const FacetSolid& nominal,
                                                   std::span<const Vec3> points) {
  std::vector<std::optional<double>> deviations(points.size());
  if (nominal.facets().empty()) return deviations;
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t k) { deviations[k] = signed_from(nominal, points[k]); });
  return deviations;
}

}  // namespace frustum::stock

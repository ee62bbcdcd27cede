#include "stock/solid/nominal_mesh.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace frustum::stock {

std::vector<std::optional<double>> deviations_from(const FacetSolid& nominal,
                                                   std::span<const Vec3> points) {
  std::vector<std::optional<double>> deviations(points.size());
  if (nominal.facets().empty()) return deviations;
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t k) { deviations[k] = nominal.signed_distance(points[k]); });
  return deviations;
}

}  // namespace frustum::stock

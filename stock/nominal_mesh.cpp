#include "stock/nominal_mesh.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace frustum::stock {

std::vector<std::optional<double>> deviations_from(const FacetSolid& nominal,
                                                   std::span<const Vec3> points) {
  std::vector<std::optional<double>> deviations(points.size());
  if (nominal.facets().empty()) return deviations;
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    deviations[k] = nominal.signed_distance(points[k]);
  });
  return deviations;
}

WorstDeviations worst_deviations(const SurfaceMesh& mesh) {
  WorstDeviations worst;
  double lowest = 0.0;
  double highest = 0.0;
  for (std::size_t v = 0; v < mesh.deviation.size(); ++v) {
    const double here = mesh.deviation[v].value_or(0.0);
    if (here < lowest) {
      lowest = here;
      worst.gouge = v;
    }
    if (here > highest) {
      highest = here;
      worst.excess = v;
    }
  }
  return worst;
}

}  // namespace frustum::stock

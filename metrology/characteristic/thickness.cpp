// Deviation of a point of a ruled surface, and thickness of a wall against its planned one: what
// both sides have too much, each along its own normal, on average.
#include <fmt/format.h>

#include "core/counted.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

Result<double> mean_deviation(const FittedFeature& side, const std::vector<std::size_t>& sections) {
  std::vector<Vec3> points = side.all_points();
  if (!sections.empty()) {
    points = side.section(sections.front());
    if (points.empty()) return about_section(side, sections.front(), {});
  }
  const NominalSurface planned = planned_surface(*side.planned);
  double sum = 0.0;
  for (const Vec3& p : points) sum += residual(planned, p);
  return sum / static_cast<double>(points.size());
}

}  // namespace

Result<Evaluated> evaluate_thickness(const Toleranced& what) {
  Evaluated out;
  out.nominal = 0.0;
  for (const FittedFeature* side : what.features) {
    const auto mean = mean_deviation(*side, what.planned.sections);
    if (!mean) return mean.error();
    out.value += *mean;
  }
  return out;
}

Result<Evaluated> evaluate_deviation(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const std::size_t point = what.planned.point.value_or(0);
  if (point >= feature.points.size()) {
    return error("too-few-points"_id,
                 fmt::format("'{}' has {}, the plan asks for point {}", feature.planned->name,
                             counted(feature.points.size(), "point"), point),
                 "points must be given in the order of the plan");
  }
  Evaluated out;
  out.nominal = 0.0;
  out.value = feature.points[point].deviation;
  return out;
}

}  // namespace frustum::metrology

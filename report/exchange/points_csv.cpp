#include "report/exchange/points_csv.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrology/plan/nominal.hpp"
#include "report/csv_field.hpp"

namespace frustum::report {
namespace {

const metrology::PlannedFeature* planned(const metrology::InspectionPlan& plan,
                                         const metrology::MeasuredFeature& feature) {
  const auto found =
      std::ranges::find(plan.features, feature.name, &metrology::PlannedFeature::name);
  return found == plan.features.end() ? nullptr : &*found;
}

std::string numbers(const Vec3& v) {
  return fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
}

}  // namespace

std::string points_csv(const metrology::Measurement& measurement,
                       const metrology::InspectionPlan& plan) {
  const bool all_planned = std::ranges::all_of(
      measurement.features, [&](const auto& each) { return planned(plan, each) != nullptr; });
  std::string csv = "feature,section,x,y,z";
  if (all_planned) csv += ",nominal_x,nominal_y,nominal_z,i,j,k,deviation";
  csv += '\n';
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    const std::string name = csv_field(feature.name);
    const metrology::PlannedFeature* const plan_of = planned(plan, feature);
    for (const metrology::MeasuredPoint& p : feature.points) {
      if (!p.point.allFinite()) continue;
      csv += fmt::format("{},{}", name, p.section) + numbers(p.point);
      if (all_planned) {
        const metrology::Element surface = metrology::planned_surface(*plan_of);
        const Vec3 normal =
            metrology::material_sign(*plan_of) * metrology::outward_normal(surface, p.point);
        const double deviation =
            metrology::material_sign(*plan_of) * metrology::residual(surface, p.point);
        csv += numbers(p.point - deviation * normal) + numbers(normal) +
               fmt::format(",{:.17g}", deviation);
      }
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace frustum::report

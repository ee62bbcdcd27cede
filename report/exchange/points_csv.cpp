#include "report/exchange/points_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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
  // What the way of milling leaves where the machine makes no error.
  const bool geometric = std::ranges::any_of(
      measurement.features, [](const auto& each) { return !each.geometric.empty(); });
  if (geometric) csv += ",geometric";
  csv += '\n';
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    const std::string name = csv_field(feature.name);
    const metrology::PlannedFeature* const plan_of = planned(plan, feature);
    const auto surface =
        all_planned ? std::optional(metrology::planned_surface(*plan_of)) : std::nullopt;
    for (std::size_t i = 0; i < feature.points.size(); ++i) {
      const metrology::MeasuredPoint& p = feature.points[i];
      if (!p.point.allFinite()) continue;
      csv += fmt::format("{},{}", name, p.section) + numbers(p.point);
      if (all_planned) {
        const double sign = metrology::material_sign(*plan_of);
        const metrology::NominalFoot foot = metrology::nearest(*surface, p.point);
        const Vec3 normal = sign * foot.normal;
        const double deviation = sign * foot.distance;
        csv += numbers(p.point - deviation * normal) + numbers(normal) +
               fmt::format(",{:.17g}", deviation);
      }
      if (geometric) {
        csv += i < feature.geometric.size() ? fmt::format(",{:.17g}", feature.geometric[i]) : ",";
      }
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace frustum::report

#include "metrology/plan/point_deviations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {

InspectionPlan with_point_deviations(InspectionPlan plan) {
  constexpr double kTolerance = 1.0;  // mm: nobody judges them
  for (const PlannedFeature& feature : plan.features) {
    if (feature.kind != FeatureKind::ruled) continue;
    const std::size_t count = planned_points(feature).size();
    for (std::size_t i = 0; i < count; ++i) {
      plan.characteristics.push_back({.name = fmt::format("{}[{}]", feature.name, i),
                                      .kind = CharacteristicKind::deviation,
                                      .features = {feature.name},
                                      .tolerance = kTolerance,
                                      .point = i});
    }
  }
  return plan;
}

InspectionPlan without_surface_profiles(InspectionPlan plan) {
  std::erase_if(plan.characteristics, [&](const PlannedCharacteristic& c) {
    return !has_derivative(c.kind) && std::ranges::all_of(c.features, [&](const std::string& name) {
      const PlannedFeature* feature = find_feature(plan, name);
      return feature != nullptr && feature->kind == FeatureKind::ruled;
    });
  });
  return plan;
}

}  // namespace frustum::metrology

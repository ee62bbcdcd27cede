#include "metrology/inspection_plan.hpp"

#include "metrology/plan_names.hpp"

namespace frustum::metrology {

std::string_view name_of(FeatureKind kind) {
  return kFeatureNames.at(static_cast<std::size_t>(kind));
}
std::string_view name_of(CharacteristicKind kind) {
  return kCharacteristicNames.at(static_cast<std::size_t>(kind));
}

const PlannedFeature* find_feature(const InspectionPlan& plan, std::string_view name) {
  for (const PlannedFeature& feature : plan.features) {
    if (feature.name == name) return &feature;
  }
  return nullptr;
}

}  // namespace frustum::metrology

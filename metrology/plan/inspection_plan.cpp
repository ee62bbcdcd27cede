#include "metrology/plan/inspection_plan.hpp"

#include "core/spline_surface.hpp"
#include "metrology/plan/plan_names.hpp"

namespace frustum::metrology {

std::string_view name_of(FeatureKind kind) {
  return kFeatureNames.at(static_cast<std::size_t>(kind));
}
bool is_round(FeatureKind kind) {
  return kind == FeatureKind::cylinder || kind == FeatureKind::cone ||
         kind == FeatureKind::circle || kind == FeatureKind::sphere;
}
bool NominalNet::operator==(const NominalNet& other) const {
  return surface == other.surface ||
         (surface != nullptr && other.surface != nullptr && *surface == *other.surface);
}

Strategy single_touch() { return RingStrategy{{0.0}, 1, 0.0, 2.0 * std::numbers::pi}; }

std::string_view name_of(CharacteristicKind kind) {
  return kCharacteristicNames.at(static_cast<std::size_t>(kind));
}

bool compares_lines(CharacteristicKind kind) {
  return kind == CharacteristicKind::line_distance || kind == CharacteristicKind::line_angle;
}
bool has_derivative(CharacteristicKind kind) {
  switch (kind) {
    case CharacteristicKind::half_angle:
    case CharacteristicKind::radius:
    case CharacteristicKind::diameter:
    case CharacteristicKind::line_distance:
    case CharacteristicKind::line_angle:
    case CharacteristicKind::thickness:
    case CharacteristicKind::deviation:
      return true;
    default:
      return false;
  }
}

bool is_angle(CharacteristicKind kind) {
  return kind == CharacteristicKind::half_angle || kind == CharacteristicKind::line_angle;
}

const PlannedFeature* find_feature(const InspectionPlan& plan, std::string_view name) {
  for (const PlannedFeature& feature : plan.features) {
    if (feature.name == name) return &feature;
  }
  return nullptr;
}
const PlannedFrame* find_frame(const InspectionPlan& plan, std::string_view name) {
  for (const PlannedFrame& frame : plan.frames) {
    if (frame.name == name) return &frame;
  }
  return nullptr;
}

}  // namespace frustum::metrology

#include "metrology/geometric_values.hpp"

#include <algorithm>

#include "metrology/cmm.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

const std::vector<double>* geometric_of(const PlannedFeature* feature) {
  if (feature == nullptr) return nullptr;
  const auto* lines = std::get_if<SurfaceLineStrategy>(&feature->strategy);
  return lines == nullptr || lines->geometric.empty() ? nullptr : &lines->geometric;
}

// The points that the plan means, moved by them.
FeaturePoints moved_points(const PlannedFeature& feature, const std::vector<double>& geometric) {
  FeaturePoints points{feature.name, {}, {}};
  const std::vector<PlannedPoint> planned = planned_points(feature);
  for (std::size_t i = 0; i < planned.size() && i < geometric.size(); ++i) {
    points.points.push_back(planned[i].point + geometric[i] * planned[i].normal);
    points.sections.push_back(planned[i].section);
  }
  return points;
}

}  // namespace

void add_geometric_values(Measurement& measurement, const InspectionPlan& plan) {
  InspectionPlan alone;
  alone.probe = plan.probe;
  alone.alignment = Alignment::plan;
  std::vector<FeaturePoints> points;
  for (const PlannedFeature& feature : plan.features) {
    const auto* geometric = geometric_of(&feature);
    if (geometric == nullptr) continue;
    alone.features.push_back(feature);
    points.push_back(moved_points(feature, *geometric));
  }
  if (points.empty()) return;
  for (MeasuredFeature& feature : measurement.features) {
    const auto* geometric = geometric_of(find_feature(plan, feature.name));
    if (geometric != nullptr && geometric->size() == feature.points.size()) {
      feature.geometric = *geometric;
    }
  }
  for (const PlannedCharacteristic& c : plan.characteristics) {
    const bool are_known = std::ranges::all_of(
        c.features, [&](const std::string& name) { return find_feature(alone, name) != nullptr; });
    if (are_known && c.frame.empty()) alone.characteristics.push_back(c);
  }
  const auto values = evaluate(alone, points);
  if (!values) return;
  for (const CharacteristicResult& value : values->characteristics) {
    if (const auto place = measurement.find(value.name)) {
      measurement.characteristics[*place].geometric = value.value;
    }
  }
}

}  // namespace frustum::metrology

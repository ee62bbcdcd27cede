#include "metrology/characteristic/datum_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/fit/best_fit.hpp"
#include "metrology/plan/nominal.hpp"
#include "metrology/plan/plan_check.hpp"

namespace frustum::metrology {
namespace {

Diagnostic missing(const std::string& name) {
  return error("feature-without-points"_id, fmt::format("datum feature '{}' has no points", name),
               "measure it, or set alignment = \"plan\"");
}

const FittedFeature* measured(std::span<const FittedFeature> features, const std::string& name) {
  const auto found = std::find_if(features.begin(), features.end(),
                                  [&](const FittedFeature& f) { return f.planned->name == name; });
  return found == features.end() ? nullptr : &*found;
}

Result<FoundDatum> best_fit_of(const DatumSystem& system, std::span<const FittedFeature> features) {
  std::vector<NominalSurface> planned;
  planned.reserve(system.best_fit.size());
  std::vector<PointOnElement> points;
  for (const std::string& name : system.best_fit) {
    const FittedFeature* feature = measured(features, name);
    if (feature == nullptr) return missing(name);
    planned.push_back(planned_surface(*feature->planned));
    for (const MeasuredPoint& p : feature->points) points.push_back({p.point, &planned.back()});
  }
  std::array<bool, 6> locked{};
  for (std::size_t k = 0; k < 6; ++k) {
    locked[k] = std::find(system.locked.begin(), system.locked.end(), kDegreeNames[k]) !=
                system.locked.end();
  }
  const auto fit = best_fit(points, locked);
  if (!fit) return fit.error();
  FoundDatum out;
  out.workpiece_from_datum = fit->measured_from_planned;
  // All take part in all.
  std::vector<std::string> told;
  for (std::size_t k = 0; k < 6; ++k) {
    (fit->is_told[k] ? told : out.free_degrees).emplace_back(kDegreeNames[k]);
  }
  for (const std::string& name : system.best_fit) out.datums.push_back({name, told});
  return out;
}

}  // namespace

Result<FoundDatum> found_datum(const DatumSystem& system, std::span<const FittedFeature> features) {
  if (!system.best_fit.empty()) return best_fit_of(system, features);
  DatumPrecedence precedence(system);
  const std::vector<std::string> names = features_of(system);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FittedFeature* feature = measured(features, names[i]);
    if (feature == nullptr) return missing(names[i]);
    const Constraints kept =
        system.base ? Constraints{} : precedence.constraints(*feature->planned);
    const auto element = datum_element(*feature, system.criterion, kept);
    if (!element) return element.error();
    precedence.add({feature->planned, *element}, i);
  }
  return precedence.found();
}

bool uses_datum(const InspectionPlan& plan) {
  return plan.alignment == Alignment::datum && plan.datum.has_value();
}

bool is_datum_feature(const InspectionPlan& plan, const PlannedFeature& feature) {
  if (!uses_datum(plan)) return false;
  const std::vector<std::string> names = features_of(*plan.datum);
  return std::find(names.begin(), names.end(), feature.name) != names.end();
}

Result<Pose> alignment_of(const InspectionPlan& plan, std::span<const FittedFeature> features) {
  if (!uses_datum(plan)) return Pose{};
  return found_datum(*plan.datum, features).transform([](FoundDatum&& found) {
    return found.workpiece_from_datum;
  });
}

}  // namespace frustum::metrology

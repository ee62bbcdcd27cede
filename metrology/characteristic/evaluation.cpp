#include "metrology/characteristic/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/characteristic/workpiece_frame.hpp"
#include "metrology/decision_rule.hpp"
#include "metrology/uncertainty/influence.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

namespace frustum::metrology {
namespace {

// The frames that characteristics ask for, each found once.
class Frames {
 public:
  Frames(const InspectionPlan& plan, std::span<const FittedFeature> in_workpiece)
      : plan_(plan), features_(in_workpiece) {}

  [[nodiscard]] const Result<Pose>& find(const std::string& name) {
    const auto known = found_.find(name);
    if (known != found_.end()) return known->second;
    return found_.emplace(name, workpiece_from_frame(plan_, *find_frame(plan_, name), features_))
        .first->second;
  }

 private:
  const InspectionPlan& plan_;
  std::span<const FittedFeature> features_;
  std::map<std::string, Result<Pose>> found_;
};

// Those of the features that the characteristic names.
std::vector<FittedFeature> named(const PlannedCharacteristic& planned, const Pose& to_from,
                                 std::span<const FittedFeature> features) {
  std::vector<FittedFeature> chosen;
  for (const FittedFeature& feature : features) {
    const auto& names = planned.features;
    if (std::find(names.begin(), names.end(), feature.planned->name) != names.end()) {
      chosen.push_back(transformed(to_from, feature));
    }
  }
  return chosen;
}

constexpr std::string_view kStateAccuracy =
    "state its accuracy: inspection.cmm of a job, or --e0 and --l-per-um of frustum measure";

// iso14253 decides by the uncertainty: without one it is no stricter than simple.
std::optional<Diagnostic> without_uncertainty(const Measurement& measurement) {
  std::string names;
  std::size_t count = 0;
  for (const CharacteristicResult& c : measurement.characteristics) {
    if (c.simulated || c.expanded_uncertainty > 0.0) continue;
    ++count;
    names += (names.empty() ? "'" : ", '") + c.name + "'";
  }
  if (count == 0) return std::nullopt;
  if (count == measurement.characteristics.size()) names = "all characteristics";
  return warning(fmt::format("decision = \"iso14253\" goes by an uncertainty of 0 for {}", names),
                 std::string(kStateAccuracy));
}

}  // namespace

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

Result<Measurement> evaluated(const InspectionPlan& plan, std::vector<FittedFeature> features,
                              const CmmModel& cmm) {
  auto measurement = evaluated_values(plan, features, cmm);
  if (!measurement) return measurement;
  if (plan.monte_carlo && point_uncertainty(cmm).is_zero()) {
    measurement->diagnostics.push_back(
        warning("uncertainty: nothing was simulated, because the CMM is said to have no errors",
                std::string(kStateAccuracy)));
  } else if (plan.monte_carlo) {
    const auto simulated = simulated_uncertainties(
        plan, features, error_draws(cmm, plan.monte_carlo->seed), *plan.monte_carlo);
    if (!simulated) return simulated.error();
    for (std::size_t i = 0; i < simulated->size(); ++i) {
      measurement->characteristics[i].simulated = (*simulated)[i];
    }
  }
  decide(*measurement, plan.decision);
  if (plan.decision == DecisionRule::iso14253) {
    if (auto undecided = without_uncertainty(*measurement)) {
      measurement->diagnostics.push_back(*std::move(undecided));
    }
  }
  return measurement;
}

Result<Measurement> evaluated_values(const InspectionPlan& plan,
                                     std::vector<FittedFeature> features, const CmmModel& cmm) {
  Measurement measurement;
  measurement.title = plan.title;
  if (uses_datum(plan)) {
    auto found = found_datum(*plan.datum, features);
    if (!found) return std::move(found).error();
    measurement.workpiece_from_datum = found->workpiece_from_datum;
    measurement.datums = std::move(found->datums);
    measurement.free_degrees = std::move(found->free_degrees);
  }
  const Pose datum_from_workpiece = measurement.workpiece_from_datum.inverse();
  std::vector<FittedFeature> in_datum;
  for (const FittedFeature& feature : features) {
    in_datum.push_back(transformed(datum_from_workpiece, feature));
    measurement.features.push_back(summary(in_datum.back()));
  }
  Frames frames(plan, features);
  Influence influence(plan, features);
  const PointUncertainty u = point_uncertainty(cmm);
  // Standard, mm or rad; a characteristic that cannot be evaluated says why elsewhere.
  const auto line_uncertainty = [&](const PlannedCharacteristic& planned) {
    if (u.is_zero() || !compares_lines(planned.kind)) return 0.0;
    const auto gradient = influence.of(planned);
    return gradient && *gradient ? std::sqrt(variance(**gradient, influence.of_field(), u)) : 0.0;
  };
  const auto result_of = [&](const PlannedCharacteristic& planned) -> Result<CharacteristicResult> {
    const double uncertainty = line_uncertainty(planned);
    if (planned.frame.empty()) {
      return evaluate(planned, in_datum, cmm, uncertainty);
    }
    const Result<Pose>& frame = frames.find(planned.frame);
    if (!frame) return frame.error();
    return evaluate(planned, named(planned, frame->inverse(), features), cmm, uncertainty);
  };
  Diagnostics failures;
  for (const PlannedCharacteristic& planned : plan.characteristics) {
    auto result = result_of(planned);
    if (result) {
      measurement.characteristics.push_back(std::move(*result));
    } else {
      failures.insert(failures.end(), result.error().begin(), result.error().end());
    }
  }
  if (has_error(failures)) return failures;
  return measurement;
}

}  // namespace frustum::metrology

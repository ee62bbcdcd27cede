#include "metrology/characteristic/measured_values.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/characteristic/workpiece_frame.hpp"

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

}  // namespace

Result<Measurement> evaluated_values(const InspectionPlan& plan,
                                     std::vector<FittedFeature> features) {
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
  const auto result_of = [&](const PlannedCharacteristic& planned) -> Result<CharacteristicResult> {
    if (planned.frame.empty()) return evaluate(planned, in_datum);
    const Result<Pose>& frame = frames.find(planned.frame);
    if (!frame) return frame.error();
    return evaluate(planned, named(planned, frame->inverse(), features));
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

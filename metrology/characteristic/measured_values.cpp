#include "metrology/characteristic/measured_values.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "core/name_index.hpp"
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

// The features that a characteristic names, in its order.
Result<std::vector<const FittedFeature*>> named(const PlannedCharacteristic& planned,
                                                std::span<const FittedFeature> features,
                                                const NameIndex& places) {
  std::vector<const FittedFeature*> chosen;
  for (const std::string& name : planned.features) {
    const auto place = places.find(name);
    if (!place) return without_points(planned, name);
    chosen.push_back(&features[*place]);
  }
  return chosen;
}

// The characteristic in another frame.
Result<CharacteristicResult> evaluate_in(const Pose& to_from, const PlannedCharacteristic& planned,
                                         const std::vector<const FittedFeature*>& features) {
  std::vector<FittedFeature> seen;
  for (const FittedFeature* feature : features) seen.push_back(transformed(to_from, *feature));
  std::vector<const FittedFeature*> chosen;
  for (const FittedFeature& feature : seen) chosen.push_back(&feature);
  return evaluate(planned, std::move(chosen));
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
  const NameIndex places(
      features, [](const FittedFeature& f) -> const std::string& { return f.planned->name; });
  Frames frames(plan, features);
  const auto result_of = [&](const PlannedCharacteristic& planned) -> Result<CharacteristicResult> {
    const bool in_frame = !planned.frame.empty();
    auto chosen = named(planned, in_frame ? features : in_datum, places);
    if (!chosen) return std::move(chosen).error();
    if (!in_frame) return evaluate(planned, *std::move(chosen));
    const Result<Pose>& frame = frames.find(planned.frame);
    if (!frame) return frame.error();
    return evaluate_in(frame->inverse(), planned, *chosen);
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

// What makes a plan impossible to measure, told to whoever knows the place in a file.
//
// Units  : as inspection_plan.hpp
// Errors : each fault is one call
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/name_index.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

enum class PlanPart { root, probe, datum, frame, feature, characteristic };

// Which part (and which one of its array, from 0), the key in it, the message, the hint.
using PlanFault =
    std::function<void(PlanPart, std::size_t, std::string_view, std::string, std::string)>;

void check(const InspectionPlan& plan, const PlanFault& fault);

// A plan and where what it names is.
struct NamedPlan {
  explicit NamedPlan(const InspectionPlan& of)
      : plan(of),
        features(of.features, &PlannedFeature::name),
        frames(of.frames, &PlannedFrame::name),
        characteristics(of.characteristics, &PlannedCharacteristic::name) {}

  [[nodiscard]] const PlannedFeature* feature(std::string_view name) const {
    const auto place = features.find(name);
    return place ? &plan.features[*place] : nullptr;
  }

  const InspectionPlan& plan;
  NameIndex features;
  NameIndex frames;
  NameIndex characteristics;
};

// What is wrong with that part: "plan-feature", ...
[[nodiscard]] DiagnosticId id_of(PlanPart part);

// Directions nearer than this (rad) to parallel or perpendicular do not fix a frame or a place.
inline constexpr double kSlack = 0.1;

using FeatureKinds = std::vector<FeatureKind>;

// The feature of that name when it exists and has one of the kinds; else tells message and hint.
// `purpose` begins the message: "a cone_form".
[[nodiscard]] const PlannedFeature* suitable(
    const NamedPlan& named, const std::string& name, const FeatureKinds& kinds,
    std::string_view purpose, const std::function<void(std::string, std::string)>& fault);

// A characteristic: its features, and whether it takes the keys it has
// (plan_check_characteristic.cpp).
void check_characteristic(const NamedPlan& named, std::size_t index, const PlanFault& fault);

// Message and hint.
using PlaceFault = std::function<void(std::string, std::string)>;
// Whether the planned places and directions of the features that a characteristic names allow what
// it asks for: parallel, perpendicular, on one axis, symmetric (plan_check_places.cpp).
void check_places(const PlannedCharacteristic& planned,
                  std::span<const PlannedFeature* const> features, const PlaceFault& fault);

// Frames and characteristics that compare lines (plan_check_lines.cpp).
void check_frame(const NamedPlan& named, std::size_t index, const PlanFault& fault);
// `first` and `second` are the two lines named, of the kind line.
void check_line_pair(const InspectionPlan& plan, std::size_t index, const PlannedFeature& first,
                     const PlannedFeature& second, const PlanFault& fault);

// A feature's strategy (plan_check_strategy.cpp). Its axis is a direction.
void check_strategy(const InspectionPlan& plan, std::size_t index, const PlanFault& fault);
// Message and hint when the sides u and v do not span an area in the feature's plane.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> fault_of_sides(
    const PlannedFeature& feature, const Vec3& u, const Vec3& v);

}  // namespace frustum::metrology

// The characteristics of a study, and the statistics of them that people name.
//
// Units  : um and urad, as samples have them; a characteristic with a nominal value counts as its
//          deviation from it
// Errors : a text that names no statistic, or one of an unknown characteristic
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::app {

inline constexpr std::string_view kVolumetricError = "volumetric.error";

struct StudyCharacteristic {
  std::string name{};
  bool angular = false;
  bool both_sides = false;  // of either sign: the limit is one of its absolute value
  std::optional<double> limit{};

  [[nodiscard]] std::string unit() const { return angular ? "urad" : "um"; }
  [[nodiscard]] bool conforms(double value) const;
};

// Those of a plan, with its tolerances as limits.
[[nodiscard]] std::vector<StudyCharacteristic> characteristics_of(
    const metrology::InspectionPlan& plan);

// "cone.equivalent_form q50": the mean or a quantile, whose interval is to be so narrow.
struct StopRule {
  std::string written{};  // without the width
  std::size_t characteristic = 0;
  std::optional<double> quantile{};  // absent: the mean
  double half_width = 0.0;           // um, urad
};

// `width`: "0.05 um".
[[nodiscard]] Result<StopRule> parse_stop_rule(std::string_view statistic, std::string_view width,
                                               std::span<const StudyCharacteristic> known);
// A length or an angle as the characteristic has it, above 0.
[[nodiscard]] Result<double> parse_limit(std::string_view text, const StudyCharacteristic& of);

[[nodiscard]] std::vector<std::string> names_of(std::span<const StudyCharacteristic> known);
[[nodiscard]] std::optional<std::size_t> place_of(std::span<const StudyCharacteristic> known,
                                                  std::string_view name);
[[nodiscard]] Diagnostic unknown_characteristic(std::string_view name,
                                                std::span<const StudyCharacteristic> known);

}  // namespace frustum::app

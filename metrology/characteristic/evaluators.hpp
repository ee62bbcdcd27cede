// One evaluator a characteristic: its value and what that is made of. The table of evaluators.cpp
// says which; docs/characteristics.md defines them.
//
// Model    : each evaluator is one family of tolerances: form.cpp, straightness.cpp,
//            orientation.cpp, location.cpp, run_out.cpp, profile.cpp, thickness.cpp, size.cpp,
//            lines.cpp
// Units    : mm, rad; all features in one frame, in which the plan holds
// Shape    : one characteristic a call
// Errors   : sections with too few points, fits and filters that fail
// Accuracy : 1e-9 mm (tests/metrology/zone_test.cpp, characteristic_test.cpp)
// Source   : ISO 1101:2017, ISO 12180, ISO 12181, ISO 12780, ISO 12781, ISO 1660
#pragma once

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/round_profile.hpp"
#include "metrology/measurement.hpp"

namespace frustum::metrology {

struct Evaluated {
  double value = 0.0;  // mm or rad
  std::optional<double> nominal{};
  RoundProfile profile{};
  std::vector<LineProfile> lines{};
  std::vector<Harmonic> harmonics{};
  std::optional<double> without_seam{};
  NonNegative measurand{};  // what the value is the size of; kind none for values of either sign
  bool has_shape = true;    // whether its interval is found from that
};

struct Toleranced {
  const PlannedCharacteristic& planned;
  std::vector<const FittedFeature*> features{};  // in the order in which it names them
};

struct ResultUnit {
  std::string_view name{};
  double per_internal = 1.0;  // such units in a mm or rad
};

struct Evaluator {
  CharacteristicKind kind{};
  Result<Evaluated> (*evaluate)(const Toleranced&) = nullptr;
  ResultUnit unit{};
};
[[nodiscard]] const Evaluator& evaluator_of(CharacteristicKind kind);
// Deviations of sizes are in um or urad.
[[nodiscard]] ResultUnit unit_of(const PlannedCharacteristic& planned);

// Least squares, without parameter, filter and harmonics.
[[nodiscard]] bool is_plain(const PlannedCharacteristic& planned);

// Those that it names, else all that were measured.
[[nodiscard]] std::set<std::size_t> sections_of(const Toleranced& what);

// form.cpp
[[nodiscard]] Result<Evaluated> evaluate_roundness(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_equivalent_cone_form(const Toleranced& what);
// Cylindricity, cone form, flatness: all points from one element.
[[nodiscard]] Result<Evaluated> evaluate_surface_form(const Toleranced& what);
// Peak to valley, highest peak, deepest valley or root mean square; deviations count out of the
// material.
[[nodiscard]] double form_parameter(FormParameter parameter, const std::vector<double>& deviations);

// straightness.cpp
[[nodiscard]] Result<Evaluated> evaluate_straightness(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_axis_straightness(const Toleranced& what);

// orientation.cpp: parallelism and angularity; perpendicularity.
[[nodiscard]] Result<Evaluated> evaluate_orientation(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_perpendicularity(const Toleranced& what);

// location.cpp
[[nodiscard]] Result<Evaluated> evaluate_position(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_coaxiality(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_concentricity(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_symmetry(const Toleranced& what);

// run_out.cpp: circular and total.
[[nodiscard]] Result<Evaluated> evaluate_run_out(const Toleranced& what);

// profile.cpp
[[nodiscard]] Result<Evaluated> evaluate_line_profile(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_surface_profile(const Toleranced& what);

// thickness.cpp
[[nodiscard]] Result<Evaluated> evaluate_thickness(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_deviation(const Toleranced& what);

// size.cpp
[[nodiscard]] Result<Evaluated> evaluate_radius(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_diameter(const Toleranced& what);
[[nodiscard]] Result<Evaluated> evaluate_half_angle(const Toleranced& what);

// lines.cpp: their distance and their angle.
[[nodiscard]] Result<Evaluated> evaluate_lines(const Toleranced& what);

}  // namespace frustum::metrology

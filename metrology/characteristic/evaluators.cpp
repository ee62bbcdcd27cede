#include "metrology/characteristic/evaluators.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/units.hpp"

namespace frustum::metrology {
namespace {

constexpr Evaluator zone_by(CharacteristicKind kind,
                            Result<Evaluated> (*evaluate)(const Toleranced&)) {
  return {kind, evaluate, {"um", kUmPerMm}};
}

// Where each characteristic is evaluated.
const auto& evaluators() {
  using enum CharacteristicKind;
  static constexpr std::array kAll{
      // Form
      zone_by(roundness, evaluate_roundness),
      zone_by(equivalent_cone_form, evaluate_equivalent_cone_form),
      zone_by(cylindricity, evaluate_surface_form),
      zone_by(cone_form, evaluate_surface_form),
      zone_by(flatness, evaluate_surface_form),
      zone_by(straightness, evaluate_straightness),
      zone_by(axis_straightness, evaluate_axis_straightness),
      // Orientation
      zone_by(parallelism, evaluate_orientation),
      zone_by(angularity, evaluate_orientation),
      zone_by(perpendicularity, evaluate_perpendicularity),
      // Location
      zone_by(position, evaluate_position),
      zone_by(coaxiality, evaluate_coaxiality),
      zone_by(concentricity, evaluate_concentricity),
      zone_by(symmetry, evaluate_symmetry),
      // Run-out
      zone_by(circular_run_out, evaluate_run_out),
      zone_by(total_run_out, evaluate_run_out),
      // Profile
      zone_by(line_profile, evaluate_line_profile),
      zone_by(surface_profile, evaluate_surface_profile),
      Evaluator{thickness, evaluate_thickness, {"um", kUmPerMm}},
      Evaluator{deviation, evaluate_deviation, {"um", kUmPerMm}},
      // Size
      Evaluator{radius, evaluate_radius, {"mm", 1.0}},
      Evaluator{diameter, evaluate_diameter, {"mm", 1.0}},
      Evaluator{half_angle, evaluate_half_angle, {"deg", kDegPerRad}},
      // Lines
      Evaluator{line_distance, evaluate_lines, {"um", kUmPerMm}},
      Evaluator{line_angle, evaluate_lines, {"urad", kUradPerRad}},
  };
  return kAll;
}

}  // namespace

const Evaluator& evaluator_of(CharacteristicKind kind) {
  const auto& all = evaluators();
  const auto* const found =
      std::find_if(all.begin(), all.end(), [&](const Evaluator& e) { return e.kind == kind; });
  assert(found != all.end());
  return *found;
}

ResultUnit unit_of(const PlannedCharacteristic& planned) {
  if (!planned.deviation) return evaluator_of(planned.kind).unit;
  return is_angle(planned.kind) ? ResultUnit{"urad", kUradPerRad} : ResultUnit{"um", kUmPerMm};
}

std::set<std::size_t> sections_of(const Toleranced& what) {
  if (!what.planned.sections.empty()) return {what.planned.sections.front()};
  std::set<std::size_t> all;
  for (const MeasuredPoint& p : what.features.front()->points) all.insert(p.section);
  return all;
}

bool is_plain(const PlannedCharacteristic& planned) {
  return planned.criterion == Criterion::least_squares && !planned.parameter && !planned.filter &&
         planned.harmonics == 0;
}

}  // namespace frustum::metrology

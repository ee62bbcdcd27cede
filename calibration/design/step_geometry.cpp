#include "calibration/design/step_geometry.hpp"

#include <cmath>
#include <optional>

namespace frustum::calibration {
namespace {

std::optional<double> value_of(const MeasuredPart& measured, const std::string& name) {
  const auto at = measured.find(name);
  if (at == measured.end()) return std::nullopt;
  return at->second.value;
}

// The sizes, when the plan has lines S of this pattern.
std::optional<StepMeasurement> sizes_of(const metrology::InspectionPlan& plan,
                                        const std::string& pattern) {
  const auto* c = find_feature(plan, pattern + ".S_c");
  const auto* d = find_feature(plan, pattern + ".S_d");
  if (c == nullptr || d == nullptr) return std::nullopt;
  StepMeasurement step;
  step.pattern = pattern;
  const Vec3 apart = d->point - c->point;
  step.width = apart.norm();
  step.centre_y = 0.5 * (c->point.y() + d->point.y());
  step.height = c->point.z();
  const auto* b = find_feature(plan, pattern + ".B_c");
  if (b == nullptr) return step;
  const Vec3 outward = -apart / step.width;  // from S_d to S_c
  step.height = b->point.z();
  step.step_height = 2.0 * (c->point.z() - b->point.z());
  step.step_width = 2.0 * (b->point - c->point).dot(outward);
  return step;
}

}  // namespace

std::vector<StepMeasurement> step_measurements(const metrology::InspectionPlan& plan,
                                               const MeasuredPart& measured) {
  std::vector<StepMeasurement> steps;
  std::string last;
  for (const auto& characteristic : plan.characteristics) {
    const std::string pattern = group_of(characteristic.name);
    if (pattern == last || !measured.contains(characteristic.name)) continue;
    last = pattern;
    auto step = sizes_of(plan, pattern);
    if (!step) continue;
    step->dL = value_of(measured, pattern + ".dL");
    step->dH = value_of(measured, pattern + ".dH");
    step->theta = value_of(measured, pattern + ".theta");
    step->phi = value_of(measured, pattern + ".phi");
    step->dL0 = value_of(measured, pattern + ".dL0");
    steps.push_back(*std::move(step));
  }
  return steps;
}

}  // namespace frustum::calibration

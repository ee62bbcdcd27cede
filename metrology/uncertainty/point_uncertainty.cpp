#include "metrology/uncertainty/point_uncertainty.hpp"

#include <cmath>

#include "metrology/probing/probe_form.hpp"

namespace frustum::metrology {
namespace {

double square(double x) { return x * x; }

// Of a point, by a probe that the statement of the machine does not contain: mean squares over all
// directions.
double probe_variance(const CmmModel& cmm) {
  if (cmm.kind == CmmKind::field || !cmm.probe) return 0.0;
  const ProbeErrors& probe = *cmm.probe;
  const double bend = bending(probe.force, cmm.stylus.value_or(Stylus{}));
  return square(probe.lobe) / 2.0 + (square(probe.ball_form) + square(bend)) / 3.0 +
         square(probe.repeatability) + square(probe.scan_noise);
}

// Of the growth of all lengths alike. What is not compensated counts whole.
double thermal_variance(const CmmModel& cmm) {
  if (!cmm.temperature) return 0.0;
  const ThermalState& t = *cmm.temperature;
  constexpr double kReference = 20.0;  // degC, ISO 1
  const double part = t.part - kReference;
  const double scales = t.scales - kReference;
  if (!t.compensated) return square(t.part_expansion * part - t.scale_expansion * scales);
  // Half widths: a third of the squares.
  return (square(t.sensor_error) * (square(t.part_expansion) + square(t.scale_expansion)) +
          square(t.expansion_error) * (square(part) + square(scales))) /
         3.0;
}

}  // namespace

PointUncertainty point_uncertainty(const CmmModel& cmm) {
  // k is in mm per um: 1 / k um per mm is 1e-3 / k.
  const double stated = cmm.length_per_error ? 0.5e-3 / *cmm.length_per_error : 0.0;
  const double point = 0.5 * cmm.e0_mm;
  const double probe = probe_variance(cmm);
  const double growth = thermal_variance(cmm);
  // A radius feels a growth whole, and a scale in one direction by half of the square.
  return {probe > 0.0 ? std::sqrt(square(point) + probe) : point,
          growth > 0.0 ? std::sqrt(square(stated) + 2.0 * growth) : stated};
}

}  // namespace frustum::metrology

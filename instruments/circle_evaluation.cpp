#include "instruments/circle_evaluation.hpp"

#include <utility>
#include <vector>

namespace frustum::instruments {
namespace {

Result<double> zone_of(const PolarSamples& samples, MinimumZones zones) {
  return zones == MinimumZones::evaluated ? minimum_zone(samples) : 0.0;
}

Result<RunValues> run_values(const CircleTrace& trace, MinimumZones zones) {
  const PolarSamples samples{trace.angle, trace.deviation};
  const auto circle = least_squares_circle(samples);
  if (!circle) return circle.error();
  const auto zone = zone_of(samples, zones);
  if (!zone) return zone.error();
  const PolarRange about_nominal = range_about(samples, {0.0, circle->x, circle->y});
  return RunValues{
      trace.sense,        *circle, range_about(samples, *circle).width(), *zone, about_nominal.most,
      about_nominal.least};
}

}  // namespace

Result<CircleValues> circle_values(std::span<const CircleTrace> traces, MinimumZones zones) {
  CircleValues values;
  std::vector<double> angle, deviation;
  for (const CircleTrace& trace : traces) {
    auto run = run_values(trace, zones);
    if (!run) return run.error();
    (trace.sense == Sense::ccw ? values.ccw : values.cw) = *std::move(run);
    angle.insert(angle.end(), trace.angle.begin(), trace.angle.end());
    deviation.insert(deviation.end(), trace.deviation.begin(), trace.deviation.end());
  }
  const PolarSamples both{angle, deviation};
  const auto circle = least_squares_circle(both);
  if (!circle) return circle.error();
  const auto zone = zone_of(both, zones);
  if (!zone) return zone.error();
  values.both = *circle;
  values.g_bi_least_squares = range_about(both, *circle).width();
  values.g_bi_minimum_zone = *zone;
  values.d_mean_radial = circle->radial;
  return values;
}

}  // namespace frustum::instruments

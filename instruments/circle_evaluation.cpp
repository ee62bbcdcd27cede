#include "instruments/circle_evaluation.hpp"

#include <utility>
#include <vector>

namespace frustum::instruments {
namespace {

Result<RunValues> run_values(const CircleTrace& trace) {
  const PolarSamples samples{trace.angle, trace.deviation};
  const auto circle = least_squares_circle(samples);
  if (!circle) return circle.error();
  const auto zone = minimum_zone(samples);
  if (!zone) return zone.error();
  const PolarRange about_nominal = range_about(samples, {0.0, circle->x, circle->y});
  return RunValues{
      trace.sense,        *circle, range_about(samples, *circle).width(), *zone, about_nominal.most,
      about_nominal.least};
}

}  // namespace

Result<CircleValues> circle_values(std::span<const CircleTrace> traces) {
  CircleValues values;
  std::vector<double> angle, deviation;
  for (const CircleTrace& trace : traces) {
    auto run = run_values(trace);
    if (!run) return run.error();
    (trace.sense == Sense::ccw ? values.ccw : values.cw) = *std::move(run);
    angle.insert(angle.end(), trace.angle.begin(), trace.angle.end());
    deviation.insert(deviation.end(), trace.deviation.begin(), trace.deviation.end());
  }
  const PolarSamples both{angle, deviation};
  const auto circle = least_squares_circle(both);
  if (!circle) return circle.error();
  const auto zone = minimum_zone(both);
  if (!zone) return zone.error();
  values.both = *circle;
  values.g_bi_least_squares = range_about(both, *circle).width();
  values.g_bi_minimum_zone = *zone;
  values.d_mean_radial = circle->radial;
  return values;
}

}  // namespace frustum::instruments

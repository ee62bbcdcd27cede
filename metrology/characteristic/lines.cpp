// Distance and angle of two lines on surfaces, less the planned: what both of them lack or have too
// much.
#include "metrology/characteristic/evaluators.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "metrology/characteristic/best_shifted_line.hpp"

namespace frustum::metrology {
namespace {

// What one line adds to the comparison.
struct ReadLine {
  LineProfile profile{};
  double turned = 0.0;  // rad, angle of the measured line less that of the planned one
};

// The place along the axes is counted from `origin`.
Result<ReadLine> read_line(const FittedFeature& feature, const LineAxes& axes, double origin) {
  const PlannedFeature& planned = *feature.planned;
  const Vec3& place = planned.point;
  const double slope = planned.axis.dot(axes.across) / planned.axis.dot(axes.along);
  std::vector<PlaceOnLine> places =
      shifted(feature.points, axes, planned.normal, place.dot(axes.height));
  ReadLine out;
  out.profile.feature = planned.name;
  for (PlaceOnLine& p : places) {
    p.across -= place.dot(axes.across) + slope * (p.along - place.dot(axes.along));
    p.along -= origin;
    out.profile.position.push_back(p.along);
    out.profile.deviation.push_back(p.across);
  }
  const auto fit = straight_line(places);
  if (!fit) {
    Diagnostics failure = fit.error();
    for (Diagnostic& d : failure) {
      d.message = fmt::format("feature '{}': {}", planned.name, d.message);
    }
    return failure;
  }
  out.profile.fit_offset = fit->offset;
  out.profile.fit_slope = fit->slope;
  out.turned = std::atan(slope + fit->slope) - std::atan(slope);
  return out;
}

// Along the axes of the first one; at an angle to it along its own, which direction and line have:
// check_line_pair.
Result<ReadLine> read_second(const FittedFeature& second, const PlannedCharacteristic& planned,
                             const LineAxes& axes, double origin) {
  const Vec3& axis = second.planned->axis;
  if (is_parallel(axis, axes.along)) return read_line(second, axes, origin);
  const LineAxes own = *line_axes(planned.kind, axis, planned.direction);
  return read_line(second, own, second.planned->point.dot(own.along));
}

}  // namespace

Result<Evaluated> evaluate_lines(const Toleranced& what) {
  const FittedFeature& first = *what.features.front();
  const FittedFeature& second = *what.features.back();
  const auto axes = line_axes(what.planned.kind, first.planned->axis, what.planned.direction);
  if (!axes) {
    return error("line-direction"_id, "the direction is along the lines", "choose one across them");
  }
  const double origin = first.planned->point.dot(axes->along);
  auto a = read_line(first, *axes, origin);
  if (!a) return std::move(a).error();
  auto b = read_second(second, what.planned, *axes, origin);
  if (!b) return std::move(b).error();
  Evaluated out;
  out.value = what.planned.kind == CharacteristicKind::line_angle
                  ? b->turned - a->turned
                  : b->profile.fit_offset - a->profile.fit_offset;
  out.nominal = 0.0;
  out.lines = {std::move(a->profile), std::move(b->profile)};
  return out;
}

}  // namespace frustum::metrology

// Circular and total run-out.
#include <algorithm>
#include <cmath>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/gaussian_filter.hpp"
#include "metrology/characteristic/harmonics.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// The feature as it turns about the datum axis.
class Turning {
 public:
  Turning(const FittedFeature& feature, const Line& axis)
      : feature_(feature), axis_(std::get<Line>(agreeing(axis, unit(feature.planned->axis)))) {
    const Vec3 along = axis_.axis;
    const Vec3 zero = zero_direction(*feature.planned);
    frame_ = {axis_.axis, (zero - zero.dot(along) * along).normalized()};
  }

  // What an indicator reads that touches across the planned surface.
  [[nodiscard]] double reading(const Vec3& p) const {
    const Vec3 w = p - axis_.point;
    const double along = w.dot(axis_.axis.vec());
    const double radius = w.cross(axis_.axis.vec()).norm();
    if (feature_.planned->kind == FeatureKind::plane) return along;
    if (feature_.planned->kind != FeatureKind::cone) return radius;
    const double angle = feature_.planned->half_angle;
    return radius * std::cos(angle) - along * std::sin(angle);
  }

  [[nodiscard]] RoundProfile read(const std::vector<Vec3>& points) const {
    RoundProfile profile;
    double mean = 0.0;
    for (const Vec3& p : points) {
      profile.angle.push_back(angle_of(p - axis_.point, frame_));
      profile.deviation.push_back(reading(p));
      mean += profile.deviation.back() / static_cast<double>(points.size());
    }
    for (double& d : profile.deviation) d -= mean;
    return profile;
  }

  // The height at which a cylinder is touched does not change what is read of it.
  [[nodiscard]] Result<std::vector<Vec3>> section(std::size_t index) const {
    if (feature_.planned->kind == FeatureKind::plane) return feature_.section(index);
    auto points = at_one_height(feature_, index, axis_.axis);
    if (!points || feature_.planned->kind == FeatureKind::cone) return points;
    return feature_.section(index);
  }

 private:
  const FittedFeature& feature_;
  Line axis_;
  AngleFrame frame_{};
};

Result<Evaluated> of_profile(const Toleranced& what, RoundProfile profile) {
  if (profile.deviation.size() < 2) {
    return error("too-few-points"_id, "a run-out of fewer than 2 points",
                 "measure two points of it or more");
  }
  Evaluated zone;
  if (what.planned.filter) {
    auto kept = closed_band(*what.planned.filter, profile.angle, profile.deviation);
    if (!kept) return std::move(kept).error();
    profile.deviation = std::move(*kept);
  }
  if (what.planned.harmonics > 0) {
    auto waves = harmonics(profile.angle, profile.deviation, what.planned.harmonics);
    if (!waves) return std::move(waves).error();
    zone.harmonics = std::move(*waves);
  }
  profile.peak_to_valley = form_parameter(FormParameter::t, profile.deviation);
  zone.value = profile.peak_to_valley;
  zone.profile = std::move(profile);
  return zone;
}

}  // namespace

Result<Evaluated> evaluate_run_out(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const std::span<const FittedFeature* const> datums = std::span(what.features).subspan(1);
  const auto axis = common_axis(datums, what.planned.datum_criterion);
  if (!axis) return axis.error();
  const Turning turning(feature, *axis);
  Evaluated worst;
  NonNegative readings{{NonNegativeKind::peak_to_valley}, {}, {}};
  const auto add = [&](const Evaluated& zone, const std::vector<Vec3>& points) {
    const std::vector<double>& parts = zone.profile.deviation;
    readings.rule.rows.push_back(points.size());
    readings.parts.insert(readings.parts.end(), parts.begin(), parts.end());
    readings.places.insert(readings.places.end(), points.begin(), points.end());
    readings.own.resize(readings.parts.size(), 1.0);
  };
  if (what.planned.kind == CharacteristicKind::total_run_out) {
    auto whole = of_profile(what, turning.read(feature.all_points()));
    if (!whole) return whole;
    add(*whole, feature.all_points());
    worst = std::move(*whole);
  } else {
    for (const std::size_t section : sections_of(what)) {
      const auto points = turning.section(section);
      if (!points) return points.error();
      auto zone = of_profile(what, turning.read(*points));
      if (!zone) return about_section(feature, section, std::move(zone).error());
      add(*zone, *points);
      if (worst.profile.angle.empty() || zone->value > worst.value) worst = std::move(*zone);
    }
  }
  worst.measurand = std::move(readings);
  return worst;
}

}  // namespace frustum::metrology

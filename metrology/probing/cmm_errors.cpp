#include "metrology/probing/cmm_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// Of the limit e0 + L/k the field keeps to this share; drift between measurements has the rest of
// L/k.
constexpr double kFieldShare = 0.9;
constexpr double kDriftShare = 0.1;  // half width
// So many standard deviations the noise of a length (two points) may reach before it passes the
// limit.
constexpr double kNoiseReach = 4.5;
// The highest and the lowest of 25 points are farther apart once in a thousand times.
constexpr double kNoiseSpread = 6.0;
// A field is left this share of e0 even where the probe takes it all.
constexpr double kLeastShare = 0.05;

constexpr double kReferenceRadius = 12.5;  // mm: the sphere of the qualification

std::vector<PlannedPoint> reference_sphere(const UnitVec3& pole) {
  PlannedFeature sphere;
  sphere.kind = FeatureKind::sphere;
  sphere.axis = pole;
  sphere.radius = kReferenceRadius;
  sphere.strategy = SphereStrategy{};
  return planned_points(sphere);
}

// The reference sphere as the probe sees it.
Result<Fit<Sphere>> seen_sphere(const ProbeForm& form, const UnitVec3& pole, const RandomKey& key,
                                double noise) {
  std::vector<Vec3> points;
  for (const PlannedPoint& p : reference_sphere(pole)) {
    const double shift =
        form.outward_shift(p.normal) + (noise > 0.0 ? noise * normal(key, points.size()) : 0.0);
    points.push_back(p.point + shift * p.normal);
  }
  return fit_sphere(points);
}

// How much larger than real the ball comes out of it.
double qualified(const Result<Fit<Sphere>>& seen) {
  return seen ? seen->element.radius - kReferenceRadius : 0.0;
}

// The most that two opposite touches add to a length, over the directions of the 25 points.
double worst_of_two(const ProbeForm& form, const UnitVec3& pole, double qualified) {
  double worst = 0.0;
  for (const PlannedPoint& p : reference_sphere(pole)) {
    worst = std::max(worst, std::abs(form.outward_shift(p.normal) + form.outward_shift(-p.normal) -
                                     2.0 * qualified));
  }
  return worst;
}

double growth_of(double part, double scales, double part_expansion, double scale_expansion) {
  constexpr double kReference = 20.0;  // degC, ISO 1
  return part_expansion * (part - kReference) - scale_expansion * (scales - kReference);
}

// What is left of thermal growth after compensation with what the sensors say.
double thermal_growth(const ThermalState& t, std::uint64_t seed, std::uint32_t draw) {
  const double real = growth_of(t.part, t.scales, t.part_expansion, t.scale_expansion);
  if (!t.compensated) return real;
  const RandomKey now{seed, draw, RandomPurpose::cmm_thermal};
  const RandomKey always{seed, 0, RandomPurpose::cmm_thermal};
  const auto within = [](const RandomKey& key, std::uint64_t index) {
    return 2.0 * uniform(key, index) - 1.0;
  };
  return real - growth_of(t.part + t.sensor_error * within(now, 0),
                          t.scales + t.sensor_error * within(now, 1),
                          t.part_expansion + t.expansion_error * within(always, 2),
                          t.scale_expansion + t.expansion_error * within(always, 3));
}

double slope_of(const CmmModel& cmm) {
  return cmm.length_per_error ? 1e-3 / *cmm.length_per_error : 0.0;  // mm per um to relative
}

// One measurement's linear field: normal terms, or the drift of the scales of a machine with a
// field.
Mat3 linear_field(const CmmModel& cmm) {
  Mat3 linear = Mat3::Zero();
  if (!cmm.length_per_error) return linear;
  if (cmm.kind == CmmKind::field) {
    const RandomKey key{cmm.seed, cmm.draw, RandomPurpose::cmm_drift};
    for (int i = 0; i < 3; ++i) {
      linear(i, i) =
          kDriftShare * slope_of(cmm) * (2.0 * uniform(key, static_cast<std::uint64_t>(i)) - 1.0);
    }
    return linear;
  }
  const double deviation = 0.5e-3 / *cmm.length_per_error;
  const RandomKey key{cmm.seed, cmm.draw, RandomPurpose::cmm_scale};
  const auto term = [&](std::uint64_t index) { return deviation * normal(key, index); };
  linear << term(0), term(3), term(4),  //
      0.0, term(1), term(5),            //
      0.0, 0.0, term(2);
  return linear;
}

}  // namespace

CmmErrors::CmmErrors(const CmmModel& cmm)
    : cmm_(cmm), probe_(probe_errors(cmm)), form_(probe_, cmm.stylus.value_or(Stylus{}), cmm.seed) {
  if (cmm_.kind == CmmKind::field) {
    const UnitVec3 pole = cmm_.stylus.value_or(Stylus{}).direction;
    const auto sphere = seen_sphere(form_, pole, {}, 0.0);
    const double systematic = worst_of_two(form_, pole, qualified(sphere));
    probing_share_ = systematic + kNoiseReach * std::sqrt(2.0) * probe_.repeatability;
    form_share_ = (sphere ? sphere->form : 0.0) + kNoiseSpread * probe_.repeatability;
    const double left = std::max(cmm_.e0_mm - probing_share_, kLeastShare * cmm_.e0_mm);
    geometry_ = GeometryField(cmm_.seed, cmm_.travel, {left, kFieldShare * slope_of(cmm_)});
  }
  start_measurement();
}

CmmErrors CmmErrors::repeated(std::uint32_t draw) const {
  CmmErrors again = *this;
  again.cmm_.draw = draw;
  again.start_measurement();
  return again;
}

void CmmErrors::start_measurement() {
  linear_ = linear_field(cmm_);
  if (cmm_.temperature) {
    linear_ += thermal_growth(*cmm_.temperature, cmm_.seed, cmm_.draw) * Mat3::Identity();
  }
  qualified_ = 0.0;
  if (probe_ == ProbeErrors{}) return;
  const RandomKey key{cmm_.seed, cmm_.draw, RandomPurpose::cmm_qualification};
  qualified_ = qualified(
      seen_sphere(form_, cmm_.stylus.value_or(Stylus{}).direction, key, probe_.repeatability));
}

Vec3 CmmErrors::systematic(const ProbedCentre& p) const {
  Vec3 seen = p.centre + linear_ * p.centre;
  if (cmm_.kind == CmmKind::field) seen += geometry_.at(p.centre + cmm_.position);
  if (!(probe_ == ProbeErrors{})) seen += form_.outward_shift(p.outward) * p.outward;
  return seen;
}

double CmmErrors::noise(const ProbedCentre& p) const {
  const auto drawn = [&](RandomPurpose purpose, double deviation) {
    return deviation > 0.0 ? deviation * normal({cmm_.seed, cmm_.draw, purpose}, p.index) : 0.0;
  };
  return drawn(RandomPurpose::cmm_point, cmm_.kind == CmmKind::linear ? 0.5 * cmm_.e0_mm : 0.0) +
         drawn(RandomPurpose::cmm_repeat, probe_.repeatability) +
         drawn(RandomPurpose::cmm_scan, p.scanned ? probe_.scan_noise : 0.0);
}

Vec3 CmmErrors::measured(const ProbedCentre& p) const {
  return systematic(p) + noise(p) * p.outward;
}

bool CmmErrors::reaches(const Vec3& centre) const {
  return cmm_.kind == CmmKind::linear || geometry_.reaches(centre + cmm_.position);
}

}  // namespace frustum::metrology

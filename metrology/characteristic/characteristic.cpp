#include "metrology/characteristic/characteristic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrology/characteristic/line_comparison.hpp"
#include "metrology/characteristic/zone.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/uncertainty/uncertainty.hpp"

namespace frustum::metrology {
namespace {

double peak_to_valley(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

// Everything a characteristic is made of, in mm and rad.
struct Value {
  double value = 0.0;
  double uncertainty = 0.0;  // standard
  std::optional<double> nominal{};
  RoundProfile profile{};
  std::vector<LineProfile> lines{};
  NonNegative magnitude{};  // what the value is the size of
};

class Evaluation {
 public:
  Evaluation(const PlannedCharacteristic& planned, std::vector<const FittedFeature*> features,
             const CmmModel& cmm, double line_uncertainty)
      : planned_(planned),
        features_(std::move(features)),
        line_uncertainty_(line_uncertainty),
        u_(point_uncertainty(cmm)) {}

  [[nodiscard]] Result<Value> operator()() const {
    const FittedFeature& feature = *features_.front();
    switch (planned_.kind) {
      case CharacteristicKind::roundness: {
        const auto points = at_one_height(feature, section(), *axis_of(feature.element));
        return round(roundness(points, angle_frame(feature)), points);
      }
      case CharacteristicKind::equivalent_cone_form: {
        const auto points = feature.section(section());
        return round(equivalent_cone_form(points, feature.planned->half_angle,
                                          -unit(feature.planned->axis), angle_frame(feature)),
                     points);
      }
      case CharacteristicKind::cylindricity:
      case CharacteristicKind::cone_form:
        return surface_form();
      case CharacteristicKind::flatness:
        return Value{feature.form, form_uncertainty(u_, 0.0), {}, {}, {}, residuals(feature)};
      case CharacteristicKind::straightness:
        return straightness();
      case CharacteristicKind::half_angle:
        return Value{std::get<Cone>(feature.element).half_angle,
                     half_angle_uncertainty(u_, feature),
                     feature.planned->half_angle,
                     {},
                     {}};
      case CharacteristicKind::perpendicularity:
        return perpendicularity();
      case CharacteristicKind::line_distance:
      case CharacteristicKind::line_angle:
        return lines();
      case CharacteristicKind::radius:
        return size(1.0);
      default:
        break;
    }
    return size(2.0);
  }

 private:
  [[nodiscard]] std::size_t section() const {
    return planned_.sections.empty() ? 0 : planned_.sections.front();
  }

  [[nodiscard]] Result<Value> round(Result<RoundProfile> profile, std::vector<Vec3> points) const {
    if (!profile) return about_section(*features_.front(), section(), profile.error());
    const double r = features_.front()->planned->radius;
    NonNegative magnitude{{NonNegativeKind::peak_to_valley}, profile->deviation, std::move(points)};
    return Value{profile->peak_to_valley, form_uncertainty(u_, r), {}, std::move(*profile), {},
                 std::move(magnitude)};
  }

  [[nodiscard]] static NonNegative residuals(const FittedFeature& feature) {
    NonNegative magnitude{{NonNegativeKind::peak_to_valley}, {}, feature.all_points()};
    for (const MeasuredPoint& p : feature.points) magnitude.parts.push_back(p.deviation);
    return magnitude;
  }

  [[nodiscard]] Value surface_form() const {
    const FittedFeature& feature = *features_.front();
    Value v{feature.form,      form_uncertainty(u_, feature.planned->radius), {}, {}, {},
            residuals(feature)};
    for (const MeasuredPoint& p : feature.points) {
      v.profile.angle.push_back(
          angle_of(p.point - point_of(feature.element), angle_frame(feature)));
      v.profile.deviation.push_back(p.deviation);
    }
    return v;
  }

  [[nodiscard]] Value straightness() const {
    const FittedFeature& feature = *features_.front();
    const Vec3 axis = *axis_of(feature.element);
    NonNegative off{{NonNegativeKind::twice_largest}, {}, feature.all_points()};
    for (const Vec3& p : off.places) {
      const Vec3 from = p - point_of(feature.element);
      const Vec3 across = from - from.dot(axis) * axis;
      off.parts.insert(off.parts.end(), across.begin(), across.end());
    }
    const double value = size_of(off);
    return {value, straightness_uncertainty(u_), {}, {}, {}, std::move(off)};
  }

  // Length of the toleranced feature over which it may tilt.
  [[nodiscard]] double extent(const Vec3& datum_direction) const {
    const PlannedFeature& planned = *features_.front()->planned;
    if (planned.kind != FeatureKind::plane) {
      const AxialExtent range = axial_extent(planned);
      return range.to - range.from;
    }
    const Vec3 normal = unit(planned.axis);
    const auto direction = UnitVec3::of(datum_direction - datum_direction.dot(normal) * normal);
    const auto across = [&](const Vec3& u, const Vec3& v) {
      // Without a direction in the plane (datum along its normal) the larger side counts.
      if (!direction) return std::max(u.norm(), v.norm());
      return std::abs(u.dot(direction->vec())) + std::abs(v.dot(direction->vec()));
    };
    if (const auto* e = std::get_if<RectangleExtent>(&planned.extent)) return across(e->u, e->v);
    if (const auto* e = std::get_if<RadialExtent>(&planned.extent)) return 2.0 * e->outer;
    if (const auto* s = std::get_if<GridStrategy>(&planned.strategy)) return across(s->u, s->v);
    const auto& rings = std::get<RingStrategy>(planned.strategy).rings;
    return 2.0 * *std::max_element(rings.begin(), rings.end());
  }

  [[nodiscard]] Value perpendicularity() const {
    const FittedFeature& toleranced = *features_.front();
    const FittedFeature& datum = *features_.back();
    const Vec3 a = *axis_of(toleranced.element);
    const Vec3 b = *axis_of(datum.element);
    const bool alike = std::holds_alternative<Plane>(toleranced.element) ==
                       std::holds_alternative<Plane>(datum.element);
    // Two planes or two axes are perpendicular when their directions are; a plane and an axis when
    // theirs are parallel.
    const double length = extent(unit(datum.planned->axis));
    const Vec3 tilt = length * (alike ? Vec3(a.dot(b), 0.0, 0.0) : Vec3(a.cross(b)));
    return {tilt.norm(),    perpendicularity_uncertainty(u_, toleranced, datum, length), {}, {}, {},
            length_of(tilt)};
  }

  [[nodiscard]] Result<Value> lines() const {
    auto compared = compare_lines(planned_, *features_.front(), *features_.back());
    if (!compared) return std::move(compared).error();
    return Value{compared->value, line_uncertainty_, 0.0, {}, std::move(compared->profiles)};
  }

  [[nodiscard]] Value size(double factor) const {
    const FittedFeature& feature = *features_.front();
    double radius = 0.0;
    double along = 0.0;
    if (const auto* cone = std::get_if<Cone>(&feature.element)) {
      // The section perpendicular to the measured axis through the nominal point.
      along = (feature.planned->point - cone->point).dot(cone->axis.vec());
      radius = cone->section_radius(along);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&feature.element)) {
      radius = cylinder->radius;
    } else if (const auto* sphere = std::get_if<Sphere>(&feature.element)) {
      radius = sphere->radius;
    } else {
      radius = std::get<Circle>(feature.element).radius;
    }
    return {factor * radius,
            factor * radius_uncertainty(u_, feature, along),
            factor * feature.planned->radius,
            {},
            {}};
  }

  const PlannedCharacteristic& planned_;
  std::vector<const FittedFeature*> features_;
  double line_uncertainty_;
  PointUncertainty u_;
};

// How a zone is found; nothing for what Evaluation finds.
using ZoneOf = Result<Zone> (*)(const Toleranced&);
ZoneOf zone_of(const PlannedCharacteristic& planned, const FittedFeature& feature) {
  const bool plain = planned.criterion == Criterion::least_squares && !planned.parameter &&
                     !planned.filter && planned.harmonics == 0;
  switch (planned.kind) {
    case CharacteristicKind::roundness:
    case CharacteristicKind::cylindricity:
    case CharacteristicKind::cone_form:
    case CharacteristicKind::flatness:
      return plain ? nullptr : form_zone;
    case CharacteristicKind::straightness:
      return plain && feature.planned->kind == FeatureKind::line ? nullptr : form_zone;
    case CharacteristicKind::axis_straightness:
      return form_zone;
    case CharacteristicKind::perpendicularity: {
      const bool as_ever = plain && planned.features.size() == 2 &&
                           planned.datum_criterion == Criterion::least_squares;
      return as_ever ? nullptr : orientation_zone;
    }
    case CharacteristicKind::parallelism:
    case CharacteristicKind::angularity:
      return orientation_zone;
    case CharacteristicKind::position:
    case CharacteristicKind::coaxiality:
    case CharacteristicKind::concentricity:
    case CharacteristicKind::symmetry:
      return location_zone;
    case CharacteristicKind::circular_run_out:
    case CharacteristicKind::total_run_out:
      return run_out_zone;
    case CharacteristicKind::line_profile:
    case CharacteristicKind::surface_profile:
      return profile_zone;
    default:
      return nullptr;
  }
}

struct Unit {
  std::string_view name;
  double per_internal;
};

Unit unit_of(CharacteristicKind kind) {
  switch (kind) {
    case CharacteristicKind::half_angle:
      return {"deg", kDegPerRad};
    case CharacteristicKind::line_angle:
      return {"urad", kUradPerRad};
    case CharacteristicKind::radius:
    case CharacteristicKind::diameter:
      return {"mm", 1.0};
    default:
      return {"um", kUmPerMm};
  }
}

}  // namespace

Result<RoundProfile> roundness(std::span<const Vec3> points, const AngleFrame& angles) {
  auto fit = fit_circle(points);
  if (!fit) return std::move(fit).error();
  RoundProfile profile;
  profile.peak_to_valley = fit->form;
  profile.deviation = std::move(fit->residuals);
  for (const Vec3& p : points) {
    profile.angle.push_back(angle_of(p - fit->element.point, angles));
  }
  return profile;
}

Result<RoundProfile> equivalent_cone_form(std::span<const Vec3> points, double half_angle,
                                          const UnitVec3& toward_apex, const AngleFrame& angles) {
  const auto circle = fit_circle(points);
  if (!circle) return circle.error();
  const Vec3 normal = circle->element.axis;
  const Vec3 axis = normal.dot(toward_apex.vec()) < 0.0 ? Vec3(-normal) : normal;
  const Vec3 foot = circle->element.point - circle->element.radius * std::tan(half_angle) * axis;
  // The polar plot turns about the measured axis.
  const Vec3 zero = (angles.zero - angles.zero.dot(axis) * axis).normalized();
  const AngleFrame about{axis.dot(angles.axis.vec()) < 0.0 ? unit(-axis) : unit(axis), zero};
  RoundProfile profile;
  std::vector<Vec3> polar;
  for (const Vec3& p : points) {
    const double angle = angle_of(p - circle->element.point, about);
    const double d = (p - foot).norm();
    profile.angle.push_back(angle);
    polar.emplace_back(d * std::cos(angle), d * std::sin(angle), 0.0);
  }
  auto fit = fit_circle_2d(polar);
  if (!fit) return std::move(fit).error();
  profile.deviation = std::move(fit->residuals);
  profile.peak_to_valley = peak_to_valley(profile.deviation);
  return profile;
}

std::vector<Vec3> at_one_height(const FittedFeature& feature, std::size_t section,
                                const Vec3& along) {
  std::vector<Vec3> points = feature.section(section);
  const auto* cone = std::get_if<Cone>(&feature.element);
  if (cone == nullptr) return points;
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : points) centroid += p / static_cast<double>(points.size());
  for (Vec3& p : points) {
    const Vec3 w = p - cone->point;
    const Vec3 lateral = (w - w.dot(cone->axis.vec()) * cone->axis.vec()).normalized();
    const Vec3 generatrix =
        std::cos(cone->half_angle) * cone->axis.vec() + std::sin(cone->half_angle) * lateral;
    p += (centroid - p).dot(along) / generatrix.dot(along) * generatrix;
  }
  return points;
}

Result<Fit<Circle>> section_circle(const FittedFeature& feature, std::size_t section,
                                   const Vec3& along) {
  auto circle = fit_circle(at_one_height(feature, section, along));
  if (!circle) return about_section(feature, section, std::move(circle).error());
  return circle;
}

Result<CharacteristicResult> evaluate(const PlannedCharacteristic& planned,
                                      std::span<const FittedFeature> features, const CmmModel& cmm,
                                      double line_uncertainty) {
  std::vector<const FittedFeature*> chosen;
  for (const std::string& name : planned.features) {
    const auto found = std::find_if(features.begin(), features.end(), [&](const FittedFeature& f) {
      return f.planned->name == name;
    });
    if (found == features.end()) {
      return error(
          fmt::format("characteristic '{}': feature '{}' has no points", planned.name, name),
          "measure the feature, or take the characteristic out of the plan");
    }
    chosen.push_back(&*found);
  }
  std::vector<Harmonic> harmonics;
  const auto evaluated = [&]() -> Result<Value> {
    const ZoneOf zone_finder = zone_of(planned, *chosen.front());
    if (zone_finder == nullptr) {
      return Evaluation(planned, chosen, cmm, line_uncertainty)();
    }
    auto zone = zone_finder({planned, chosen, point_uncertainty(cmm)});
    if (!zone) return std::move(zone).error();
    harmonics = std::move(zone->harmonics);
    return Value{zone->value, zone->uncertainty,         {}, std::move(zone->profile),
                 {},          std::move(zone->magnitude)};
  };
  auto value = evaluated();
  if (!value) {
    Diagnostics failure = std::move(value).error();
    for (Diagnostic& d : failure) {
      d.message = fmt::format("characteristic '{}': {}", planned.name, d.message);
    }
    return failure;
  }
  const Unit unit = unit_of(planned.kind);
  CharacteristicResult result;
  result.name = planned.name;
  result.kind = std::string(name_of(planned.kind));
  result.unit = std::string(unit.name);
  result.value = value->value * unit.per_internal;
  if (value->nominal) result.nominal = *value->nominal * unit.per_internal;
  result.tolerance = planned.tolerance * unit.per_internal;
  constexpr double kCoverage = 2.0;  // 95 % of a normal distribution
  result.expanded_uncertainty = kCoverage * value->uncertainty * unit.per_internal;
  result.pass = std::abs(value->value - value->nominal.value_or(0.0)) <= planned.tolerance;
  result.plot_angle = std::move(value->profile.angle);
  result.plot_deviation = std::move(value->profile.deviation);
  result.profiles = std::move(value->lines);
  result.harmonics = std::move(harmonics);
  result.magnitude = std::move(value->magnitude);
  return result;
}

}  // namespace frustum::metrology

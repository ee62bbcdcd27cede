// Whether a part as planned would hold its own characteristics: fills in plan_check.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "metrology/fit/median_plane.hpp"
#include "metrology/plan/plan_check.hpp"

namespace frustum::metrology {
namespace {

using Features = std::span<const PlannedFeature* const>;

constexpr double kAskew = 1e-3;  // rad: nobody plans that on purpose
constexpr double kApart = 0.01;  // mm: coordinates written to the last um do not add up to it

bool is_plane(const PlannedFeature& feature) { return feature.kind == FeatureKind::plane; }

// 0 to a right angle, between directions of either sense.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

// Of faces and axes themselves: a plane lies as its normal does not.
double angle_between(const PlannedFeature& a, const PlannedFeature& b) {
  const double angle = angle_between(unit(a.axis).vec(), unit(b.axis).vec());
  return is_plane(a) == is_plane(b) ? angle : 0.5 * std::numbers::pi - angle;
}

std::string degrees(double angle) { return fmt::format("{:.6g} deg", angle * kDegPerRad); }

class PlacesCheck {
 public:
  PlacesCheck(const PlannedCharacteristic& planned, Features features, const PlaceFault& fault)
      : planned_(planned), features_(features), fault_(fault) {}

  void run() const {
    using enum CharacteristicKind;
    switch (planned_.kind) {
      case parallelism:
      case perpendicularity:
        if (features_.size() == 2) orientation();
        break;
      case concentricity:
      case coaxiality:
      case circular_run_out:
      case total_run_out:
        for (const PlannedFeature* feature : features_) on_one_axis(*feature);
        break;
      case symmetry:
        symmetric();
        break;
      default:
        break;
    }
  }

 private:
  void orientation() const {
    const bool parallel = planned_.kind == CharacteristicKind::parallelism;
    const double angle = angle_between(*features_[0], *features_[1]);
    if (std::abs(angle - (parallel ? 0.0 : 0.5 * std::numbers::pi)) <= kAskew) return;
    fault_(fmt::format("'{}' and '{}' must be planned {}, they are {} apart", features_[0]->name,
                       features_[1]->name, parallel ? "parallel" : "perpendicular", degrees(angle)),
           "angularity compares with the planned angle");
  }

  // The datum that follows the toleranced feature is the axis that all of them share.
  void on_one_axis(const PlannedFeature& feature) const {
    if (features_.size() < 2 || &feature == features_[1]) return;
    const PlannedFeature& datum = *features_[1];
    const Line axis{datum.point, unit(datum.axis)};
    const double angle = angle_between(unit(feature.axis).vec(), axis.axis.vec());
    const bool is_sphere = feature.kind == FeatureKind::sphere;
    if (!is_sphere && angle > kAskew) {
      wrong(feature, datum,
            is_plane(feature) ? "must be planned perpendicular to the axis of"
                              : "must be planned on the axis of",
            degrees(angle));
      return;
    }
    // A face reaches anywhere along the axis and across it.
    const double apart = residual(axis, feature.point);
    if (!is_plane(feature) && apart > kApart) {
      wrong(feature, datum, "must be planned on the axis of", fmt::format("{:.6g} mm", apart));
    }
  }
  void wrong(const PlannedFeature& feature, const PlannedFeature& datum, std::string_view what,
             const std::string& off) const {
    fault_(fmt::format("'{}' {} '{}', it is {} off", feature.name, what, datum.name, off),
           feature.kind == FeatureKind::sphere || is_plane(feature)
               ? ""
               : "position compares with a planned place");
  }

  void symmetric() const {
    const std::size_t toleranced = is_plane(*features_[0]) && features_.size() > 2 ? 2 : 1;
    const Place datum = middle(features_.subspan(toleranced), nullptr);
    const Place place = middle(features_.first(toleranced), &datum);
    const bool alike = place.is_plane == datum.is_plane;
    const double between = angle_between(place.direction.vec(), datum.direction.vec());
    const double askew = alike ? between : 0.5 * std::numbers::pi - between;
    // Two axes are one line; else a plane holds what is compared with it.
    const Plane plane = place.is_plane && !datum.is_plane ? Plane{place.point, place.direction}
                                                          : Plane{datum.point, datum.direction};
    const Vec3& other = place.is_plane && !datum.is_plane ? datum.point : place.point;
    const double apart = place.is_plane || datum.is_plane
                             ? std::abs(residual(plane, other))
                             : residual(Line{datum.point, datum.direction}, other);
    if (askew <= kAskew && apart <= kApart) return;
    fault_(fmt::format("{} must be planned symmetric about {}, {} off",
                       names(features_.first(toleranced)), names(features_.subspan(toleranced)),
                       askew > kAskew ? "they are " + degrees(askew)
                                      : fmt::format("they are {:.6g} mm", apart)),
           "features = toleranced first, then the datum; two faces count by the plane midway");
  }

  struct Place {
    bool is_plane = false;
    Vec3 point = Vec3::Zero();
    UnitVec3 direction = UnitVec3::z();
  };
  // Of two faces the plane midway: towards `datum`, or between the sides that look most alike.
  static Place middle(Features features, const Place* datum) {
    const PlannedFeature& first = *features.front();
    if (features.size() == 1) return {is_plane(first), first.point, unit(first.axis)};
    const PlannedFeature& second = *features.back();
    const UnitVec3 a = unit(first.axis);
    const UnitVec3 b = unit(second.axis);
    const double sense = datum == nullptr ? sense_between(a, b)
                                          : sense_towards(a, b, datum->direction, !datum->is_plane);
    const Plane median = median_plane({first.point, a}, {second.point, b}, sense);
    return {true, median.point, median.axis};
  }
  static std::string names(Features features) {
    std::string all = fmt::format("'{}'", features.front()->name);
    if (features.size() > 1) all += fmt::format(" and '{}'", features.back()->name);
    return all;
  }

  const PlannedCharacteristic& planned_;
  Features features_;
  const PlaceFault& fault_;
};

}  // namespace

void check_places(const PlannedCharacteristic& planned,
                  std::span<const PlannedFeature* const> features, const PlaceFault& fault) {
  PlacesCheck(planned, features, fault).run();
}

}  // namespace frustum::metrology

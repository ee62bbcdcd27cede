#include "metrology/plan/plan_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/spelling.hpp"
#include "core/spline_surface.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/plan/datum_precedence.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// Squares of what is longer or shorter leave the range of doubles; nobody writes it on purpose.
bool has_sound_length(const Vec3& direction) {
  const double length = direction.stableNorm();
  return length > 1e-100 && length < 1e100;
}
constexpr double kFarthest = 1e9;  // mm: a thousand kilometres

class FeatureCheck {
 public:
  FeatureCheck(const InspectionPlan& plan, std::size_t index, const PlanFault& fault)
      : plan_(plan), feature_(plan.features[index]), index_(index), fault_(fault) {}

  void run() const {
    if (feature_.kind == FeatureKind::ruled) {
      net();
      return;
    }
    if (!(feature_.point.cwiseAbs().maxCoeff() <= kFarthest)) {
      wrong("point", fmt::format("must be three numbers of at most {:g} mm", kFarthest));
    }
    for (const auto& [key, direction] : {std::pair<std::string_view, Vec3>{"axis", feature_.axis},
                                         {"zero", feature_.zero.value_or(feature_.axis)},
                                         {"normal", feature_.normal}}) {
      if (has_sound_length(direction) || direction == Vec3::Zero()) continue;
      wrong(key, "must be a direction, of a length between 1e-100 and 1e100",
            "for example [0, 0, 1]");
      return;
    }
    if (!UnitVec3::of(feature_.axis)) {
      wrong("axis", "must be a direction, is [0, 0, 0]");
      return;
    }
    if (feature_.zero && !UnitVec3::of(feature_.zero->cross(feature_.axis))) {
      wrong("zero", "the direction where angles start must not be along the axis");
    }
    if (is_round(feature_.kind)) round_geometry();
    if (feature_.kind == FeatureKind::line && !UnitVec3::of(feature_.normal.cross(feature_.axis))) {
      wrong("normal", "must point away from the surface, across the axis of the line");
    }
    extent();
    check_strategy(plan_, index_, fault_);
  }

 private:
  void wrong(std::string_view key, std::string message, std::string hint = {}) const {
    fault_(PlanPart::feature, index_, key, std::move(message), std::move(hint));
  }

  // Nothing of a strategy can be checked where there is no surface.
  void net() const {
    const auto& surface = feature_.net.surface;
    if (surface == nullptr || surface->rows() != 2) {
      wrong("lower", "a ruled surface needs two curves", "lower and upper: lists of [x, y, z]");
      return;
    }
    for (const Vec3& p : surface->net()) {
      if (p.cwiseAbs().maxCoeff() <= kFarthest) continue;
      wrong("lower",
            fmt::format("control points must be three numbers of at most {:g} mm", kFarthest));
      return;
    }
    if (!surface->has_normals()) {
      wrong("upper", "the surface between the curves folds, or has no area",
            "both curves must run the same way, apart from each other");
      return;
    }
    check_strategy(plan_, index_, fault_);
  }

  void round_geometry() const {
    const bool cone = feature_.kind == FeatureKind::cone;
    if (!(feature_.radius > 0.0)) {
      wrong(cone ? "section_radius" : "radius",
            fmt::format("must be greater than 0, is {}", feature_.radius));
    }
    if (cone && !(feature_.half_angle > 0.0 && feature_.half_angle < std::numbers::pi / 2.0)) {
      wrong(
          "half_angle",
          fmt::format("must be between 0 and 90 deg, is {:.6g}", feature_.half_angle * kDegPerRad),
          "turn the axis toward the growing radius instead of a negative angle");
    }
    if (feature_.side == Side::inside && feature_.radius <= 0.5 * plan_.probe.ball_diameter) {
      wrong(cone ? "section_radius" : "radius",
            fmt::format("a ball of {} mm does not go into a hole of radius {} mm",
                        plan_.probe.ball_diameter, feature_.radius),
            "choose a smaller probe.ball_diameter");
    }
  }

  void extent() const {
    if (std::holds_alternative<std::monostate>(feature_.extent)) return;
    const bool plane = feature_.kind == FeatureKind::plane;
    if (feature_.kind == FeatureKind::point || feature_.kind == FeatureKind::sphere) {
      wrong("extent", fmt::format("a {} has none", name_of(feature_.kind)));
      return;
    }
    const auto* axial = std::get_if<AxialExtent>(&feature_.extent);
    const auto* radial = std::get_if<RadialExtent>(&feature_.extent);
    const auto* rectangle = std::get_if<RectangleExtent>(&feature_.extent);
    if (plane == (axial != nullptr)) {
      wrong("extent", fmt::format("this extent does not suit a {}", name_of(feature_.kind)),
            "plane: inner and outer, or u and v; others: from and to");
    } else if (axial != nullptr && !(axial->from < axial->to)) {
      wrong("extent", fmt::format("from = {} must be less than to = {}", axial->from, axial->to));
    } else if (radial != nullptr && !(radial->inner >= 0.0 && radial->inner < radial->outer)) {
      wrong("extent", fmt::format("inner = {} must be less than outer = {}, neither negative",
                                  radial->inner, radial->outer));
    } else if (rectangle != nullptr) {
      if (const auto fault = fault_of_sides(feature_, rectangle->u, rectangle->v)) {
        wrong("extent", fault->first, fault->second);
      }
      // 1e-6 of the sides: a rectangle to the last um over a metre.
      if (std::abs(rectangle->u.dot(rectangle->v)) >
          1e-6 * rectangle->u.norm() * rectangle->v.norm()) {
        wrong("extent", "u and v must be perpendicular to each other");
      }
    }
  }

  const InspectionPlan& plan_;
  const PlannedFeature& feature_;
  std::size_t index_;
  const PlanFault& fault_;
};

std::vector<std::string> feature_names(const InspectionPlan& plan) {
  std::vector<std::string> names;
  for (const PlannedFeature& feature : plan.features) names.push_back(feature.name);
  return names;
}

std::string listed(const FeatureKinds& kinds) {
  std::vector<std::string_view> names;
  for (const FeatureKind kind : kinds) names.push_back(name_of(kind));
  return fmt::format("{}", fmt::join(names, " or "));
}

// Datums by order of precedence: each must take a degree of freedom.
void check_precedence(const NamedPlan& named, const PlanFault& fault) {
  using enum FeatureKind;
  const InspectionPlan& plan = named.plan;
  const DatumSystem& datum = *plan.datum;
  constexpr std::array<std::string_view, 3> kKeys{"primary", "secondary", "tertiary"};
  const std::array<const std::string*, 3> names{&datum.primary, &datum.secondary, &datum.tertiary};
  bool sound = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto wrong = [&](std::string message, std::string hint) {
      sound = false;
      fault(PlanPart::datum, 0, kKeys[i], std::move(message), std::move(hint));
    };
    if (names[i]->empty()) {
      if (i == 0) wrong("must not be empty", "name a feature, or write best_fit");
      if (i == 1 && !datum.tertiary.empty()) wrong("a tertiary datum needs a secondary one", "");
      continue;
    }
    const PlannedFeature* feature = suitable(
        named, *names[i], {plane, cylinder, cone, circle, line, sphere, point}, "a datum", wrong);
    if (feature != nullptr && !UnitVec3::of(feature->axis)) sound = false;
    if (feature != nullptr && feature->kind == cone &&
        datum.criterion == Criterion::outside_material) {
      wrong(fmt::format("'{}' is a cone, which has no association \"om\"", *names[i]),
            "choose criterion = \"ls\": a cone has no largest or smallest size");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (*names[j] == *names[i]) wrong(fmt::format("'{}' is named twice", *names[i]), "");
    }
  }
  if (!sound) return;
  const std::vector<DatumShare> shares = planned_shares(plan, datum);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!shares[i].degrees.empty()) continue;
    fault(PlanPart::datum, 0, kKeys[i],
          fmt::format("'{}' takes no degree of freedom that the datums before it left",
                      shares[i].feature),
          "leave it out, or choose a feature that is across them");
  }
}

void check_best_fit(const NamedPlan& named, const PlanFault& fault) {
  const DatumSystem& datum = *named.plan.datum;
  const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
    fault(PlanPart::datum, 0, key, std::move(message), std::move(hint));
  };
  if (!datum.primary.empty() || !datum.secondary.empty() || !datum.tertiary.empty()) {
    wrong("best_fit", "excludes primary, secondary and tertiary");
  }
  if (datum.criterion != Criterion::least_squares || datum.base) {
    wrong("criterion", "a best fit is one of least squares", "leave it out");
  }
  const NameIndex places(datum.best_fit, std::identity());
  for (std::size_t i = 0; i < datum.best_fit.size(); ++i) {
    const std::string& name = datum.best_fit[i];
    if (named.feature(name) == nullptr) {
      wrong("best_fit", fmt::format("the plan has no feature '{}'", name),
            suggestion(name, feature_names(named.plan)));
    }
    if (places.find(name) != i) {
      wrong("best_fit", fmt::format("'{}' is named twice", name));
    }
  }
}

void check_datum(const NamedPlan& named, const PlanFault& fault) {
  const DatumSystem& datum = *named.plan.datum;
  const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
    fault(PlanPart::datum, 0, key, std::move(message), std::move(hint));
  };
  if (datum.criterion != Criterion::least_squares &&
      datum.criterion != Criterion::outside_material) {
    wrong("criterion", "a datum is associated by \"ls\", \"om\" or \"base\"");
  }
  for (const std::string& degree : datum.locked) {
    if (std::find(kDegreeNames.begin(), kDegreeNames.end(), degree) == kDegreeNames.end()) {
      wrong("locked", fmt::format("'{}' is not a degree of freedom", degree),
            "TX, TY, TZ: shifts along the axes of the workpiece; RX, RY, RZ: rotations about them");
    }
  }
  if (!datum.best_fit.empty()) {
    check_best_fit(named, fault);
    return;
  }
  if (!datum.locked.empty()) wrong("locked", "only a best_fit has locked degrees");
  check_precedence(named, fault);
}

std::string key_path(PlanPart part, std::size_t index, std::string_view key) {
  switch (part) {
    case PlanPart::root:
      break;
    case PlanPart::probe:
      return fmt::format("probe.{}", key);
    case PlanPart::datum:
      return fmt::format("datum.{}", key);
    case PlanPart::frame:
      return fmt::format("frame[{}].{}", index + 1, key);
    case PlanPart::feature:
      return fmt::format("feature[{}].{}", index + 1, key);
    case PlanPart::characteristic:
      return fmt::format("characteristic[{}].{}", index + 1, key);
  }
  return std::string(key);
}

}  // namespace

DiagnosticId id_of(PlanPart part) {
  switch (part) {
    case PlanPart::root:
      break;
    case PlanPart::probe:
      return "plan-probe"_id;
    case PlanPart::datum:
      return "plan-datum"_id;
    case PlanPart::frame:
      return "plan-frame"_id;
    case PlanPart::feature:
      return "plan-feature"_id;
    case PlanPart::characteristic:
      return "plan-characteristic"_id;
  }
  return "plan"_id;
}

const PlannedFeature* suitable(const NamedPlan& named, const std::string& name,
                               const FeatureKinds& kinds, std::string_view purpose,
                               const std::function<void(std::string, std::string)>& fault) {
  const PlannedFeature* feature = named.feature(name);
  if (feature == nullptr) {
    fault(fmt::format("the plan has no feature '{}'", name),
          suggestion(name, feature_names(named.plan)));
    return nullptr;
  }
  if (std::find(kinds.begin(), kinds.end(), feature->kind) == kinds.end()) {
    fault(fmt::format("{} needs a {}, '{}' is a {}", purpose, listed(kinds), name,
                      name_of(feature->kind)),
          "");
    return nullptr;
  }
  return feature;
}

void check(const InspectionPlan& plan, const PlanFault& fault) {
  const auto positive = [&](std::string_view key, double value) {
    if (!(value > 0.0)) {
      fault(PlanPart::probe, 0, key, fmt::format("must be greater than 0, is {}", value), "");
    }
  };
  positive("ball_diameter", plan.probe.ball_diameter);
  positive("clearance", plan.probe.clearance);
  positive("reach", plan.probe.reach);
  if (plan.features.empty()) {
    fault(PlanPart::root, 0, "feature", "the plan has no feature",
          "write at least one [[feature]]");
  }
  const NamedPlan named(plan);
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    const std::string& name = plan.features[i].name;
    if (name.empty()) fault(PlanPart::feature, i, "name", "must not be empty", "");
    if (named.features.find(name) != i) {
      fault(PlanPart::feature, i, "name", fmt::format("'{}' names two features", name), "");
    }
    FeatureCheck(plan, i, fault).run();
  }
  if (plan.datum) check_datum(named, fault);
  for (std::size_t i = 0; i < plan.frames.size(); ++i) check_frame(named, i, fault);
  for (std::size_t i = 0; i < plan.characteristics.size(); ++i) {
    check_characteristic(named, i, fault);
  }
}

Diagnostics check(const InspectionPlan& plan) {
  Diagnostics found;
  check(plan, [&](PlanPart part, std::size_t index, std::string_view key, std::string message,
                  std::string hint) {
    Diagnostic d = error(id_of(part), std::move(message), std::move(hint));
    d.key = key_path(part, index, key);
    found.push_back(std::move(d));
  });
  return found;
}

}  // namespace frustum::metrology

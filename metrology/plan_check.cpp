#include "metrology/plan_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"
#include "metrology/element.hpp"
#include "metrology/strategy.hpp"

namespace frustum::metrology {
namespace {

class FeatureCheck {
 public:
  FeatureCheck(const InspectionPlan& plan, std::size_t index, const PlanFault& fault)
      : plan_(plan), feature_(plan.features[index]), index_(index), fault_(fault) {}

  void run() const {
    if (!feature_.point.allFinite()) wrong("point", "must be three finite numbers");
    if (!UnitVec3::of(feature_.axis)) {
      wrong("axis", "must be a direction, is [0, 0, 0]");
      return;
    }
    if (feature_.zero && !UnitVec3::of(feature_.zero->cross(feature_.axis))) {
      wrong("zero", "the direction where angles start must not lie along the axis");
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

  void round_geometry() const {
    const bool cone = feature_.kind == FeatureKind::cone;
    if (!(feature_.radius > 0.0)) {
      wrong(cone ? "section_radius" : "radius",
            fmt::format("must be greater than 0, is {}", feature_.radius));
    }
    if (cone && !(feature_.half_angle > 0.0 && feature_.half_angle < std::numbers::pi / 2.0)) {
      wrong(
          "half_angle",
          fmt::format("must lie between 0 and 90 deg, is {:.6g}", feature_.half_angle * kDegPerRad),
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

void check_datum(const InspectionPlan& plan, const PlanFault& fault) {
  const DatumSystem& datum = *plan.datum;
  const auto named = [&](std::string_view key, const std::string& name, const FeatureKinds& kinds) {
    return suitable(plan, name, kinds, fmt::format("the {} datum", key),
                    [&](std::string message, std::string hint) {
                      fault(PlanPart::datum, 0, key, std::move(message), std::move(hint));
                    });
  };
  const PlannedFeature* primary = named("primary", datum.primary, {FeatureKind::plane});
  const PlannedFeature* secondary =
      named("secondary", datum.secondary, {FeatureKind::cylinder, FeatureKind::cone});
  const PlannedFeature* tertiary = nullptr;
  if (!datum.tertiary.empty()) tertiary = named("tertiary", datum.tertiary, {FeatureKind::plane});
  if (primary == nullptr || !UnitVec3::of(primary->axis)) return;
  const UnitVec3 z = unit(primary->axis);
  if (secondary != nullptr && UnitVec3::of(secondary->axis) &&
      std::abs(z.vec().dot(unit(secondary->axis).vec())) < kSlack) {
    fault(PlanPart::datum, 0, "secondary", "its axis does not pierce the primary plane", "");
  }
  if (tertiary != nullptr && UnitVec3::of(tertiary->axis) &&
      z.vec().cross(unit(tertiary->axis).vec()).norm() < kSlack) {
    fault(PlanPart::datum, 0, "tertiary", "it is parallel to the primary plane", "");
  }
}

FeatureKinds kinds_for(CharacteristicKind kind) {
  using enum FeatureKind;
  switch (kind) {
    case CharacteristicKind::cylindricity:
      return {cylinder};
    case CharacteristicKind::cone_form:
    case CharacteristicKind::equivalent_cone_form:
    case CharacteristicKind::half_angle:
      return {cone};
    case CharacteristicKind::flatness:
      return {plane};
    case CharacteristicKind::straightness:
    case CharacteristicKind::line_distance:
    case CharacteristicKind::line_angle:
      return {line};
    case CharacteristicKind::concentricity:
      return {cylinder, cone};
    case CharacteristicKind::perpendicularity:
      return {plane, cylinder, cone};
    case CharacteristicKind::roundness:
    case CharacteristicKind::radius:
    case CharacteristicKind::diameter:
      break;
  }
  return {cylinder, cone, circle};
}

void check_characteristic(const InspectionPlan& plan, std::size_t index, const PlanFault& fault) {
  const PlannedCharacteristic& c = plan.characteristics[index];
  const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
    fault(PlanPart::characteristic, index, key, std::move(message), std::move(hint));
  };
  if (c.name.empty()) wrong("name", "must not be empty");
  for (std::size_t i = 0; i < index; ++i) {
    if (plan.characteristics[i].name == c.name) {
      wrong("name", fmt::format("'{}' names two characteristics", c.name));
    }
  }
  if (!(c.tolerance > 0.0)) wrong("tolerance", "must be greater than 0");
  const bool lines = compares_lines(c.kind);
  const bool pair = lines || c.kind == CharacteristicKind::perpendicularity;
  const bool maybe_pair = c.kind == CharacteristicKind::concentricity;
  if (c.features.empty() || (pair && c.features.size() != 2) || c.features.size() > 2 ||
      (!pair && !maybe_pair && c.features.size() != 1)) {
    wrong("features", fmt::format("a {} takes {}, named are {}", name_of(c.kind),
                                  lines        ? "two lines: first, second"
                                  : pair       ? "two features: toleranced, datum"
                                  : maybe_pair ? "one feature or two"
                                               : "one feature",
                                  c.features.size()));
    return;
  }
  std::vector<const PlannedFeature*> features;
  for (const std::string& name : c.features) {
    features.push_back(suitable(plan, name, kinds_for(c.kind), fmt::format("a {}", name_of(c.kind)),
                                [&](std::string message, std::string hint) {
                                  wrong(c.features.size() == 1 ? "feature" : "features",
                                        std::move(message), std::move(hint));
                                }));
    if (features.back() == nullptr) return;
  }
  if (lines) {
    check_line_pair(plan, index, *features[0], *features[1], fault);
  } else {
    const std::string only = "only line_distance and line_angle take one";
    if (!c.frame.empty()) wrong("frame", fmt::format("not for a {}", name_of(c.kind)), only);
    if (c.direction != Vec3::Zero()) {
      wrong("direction", fmt::format("not for a {}", name_of(c.kind)), only);
    }
  }
  const std::size_t most = maybe_pair ? 2 : 1;
  const bool takes_sections = maybe_pair || c.kind == CharacteristicKind::roundness ||
                              c.kind == CharacteristicKind::equivalent_cone_form;
  if (!takes_sections && !c.sections.empty()) {
    wrong("section", fmt::format("a {} concerns the whole feature", name_of(c.kind)));
  } else if (!c.sections.empty() && c.sections.size() != most) {
    wrong("sections", fmt::format("a {} takes {} section{}, named are {}", name_of(c.kind), most,
                                  most == 1 ? "" : "s", c.sections.size()));
  } else {
    for (std::size_t i = 0; i < c.sections.size(); ++i) {
      const PlannedFeature& feature = *features[std::min(i, features.size() - 1)];
      if (c.sections[i] >= section_count(feature)) {
        wrong(most == 1 ? "section" : "sections",
              fmt::format("'{}' has {} sections, there is no section {}", feature.name,
                          section_count(feature), c.sections[i]),
              "the first section is 0");
      }
    }
  }
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

const PlannedFeature* suitable(const InspectionPlan& plan, const std::string& name,
                               const FeatureKinds& kinds, std::string_view purpose,
                               const std::function<void(std::string, std::string)>& fault) {
  const PlannedFeature* feature = find_feature(plan, name);
  if (feature == nullptr) {
    fault(fmt::format("the plan has no feature '{}'", name), suggestion(name, feature_names(plan)));
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
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    const std::string& name = plan.features[i].name;
    if (name.empty()) fault(PlanPart::feature, i, "name", "must not be empty", "");
    if (find_feature(plan, name) != &plan.features[i]) {
      fault(PlanPart::feature, i, "name", fmt::format("'{}' names two features", name), "");
    }
    FeatureCheck(plan, i, fault).run();
  }
  if (plan.datum) check_datum(plan, fault);
  for (std::size_t i = 0; i < plan.frames.size(); ++i) check_frame(plan, i, fault);
  for (std::size_t i = 0; i < plan.characteristics.size(); ++i) {
    check_characteristic(plan, i, fault);
  }
}

Diagnostics check(const InspectionPlan& plan) {
  Diagnostics found;
  check(plan, [&](PlanPart part, std::size_t index, std::string_view key, std::string message,
                  std::string hint) {
    Diagnostic d = error(std::move(message), std::move(hint));
    d.key = key_path(part, index, key);
    found.push_back(std::move(d));
  });
  return found;
}

}  // namespace frustum::metrology

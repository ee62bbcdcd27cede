#include "metrology/fit/constraint_steps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace frustum::metrology {
namespace {

// Directions that users or other fits give carry some 1e-12: nearer than this they agree.
constexpr double kSameDirection = 1e-9;

bool has_axis(ElementKind kind) { return kind != ElementKind::sphere; }

bool is_round(ElementKind kind) {
  return kind == ElementKind::circle || kind == ElementKind::cylinder ||
         kind == ElementKind::cone || kind == ElementKind::torus;
}

bool has_radius(ElementKind kind) {
  return kind == ElementKind::circle || kind == ElementKind::sphere ||
         kind == ElementKind::cylinder || kind == ElementKind::torus;
}

std::optional<Diagnostic> lacking(const Constraints& c, ElementKind kind, std::string_view what) {
  if ((c.parallel_to || c.perpendicular_to) && !has_axis(kind)) {
    return error("constraint-not-applicable"_id, fmt::format("a {} has no direction to keep", what),
                 "leave out parallel_to and perpendicular_to");
  }
  if (c.axis && !is_round(kind)) {
    return error("constraint-not-applicable"_id, fmt::format("a {} cannot keep an axis", what),
                 "an axis can be kept by circle, cylinder, cone and torus");
  }
  if (c.radius && !has_radius(kind)) {
    return error("constraint-not-applicable"_id, fmt::format("a {} has no radius to keep", what),
                 kind == ElementKind::cone
                     ? "a cone has one at every height; fix half_angle instead"
                     : "leave out radius");
  }
  if (c.tube_radius && kind != ElementKind::torus) {
    return error("constraint-not-applicable"_id,
                 fmt::format("a {} has no tube_radius to keep", what), "leave out tube_radius");
  }
  if (c.half_angle && kind != ElementKind::cone) {
    return error("constraint-not-applicable"_id,
                 fmt::format("a {} has no half_angle to keep", what), "leave out half_angle");
  }
  return std::nullopt;
}

std::optional<Diagnostic> senseless(const Constraints& c) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (c.radius && !positive(*c.radius)) {
    return error("constraint-value"_id, fmt::format("the radius to keep is {} mm", *c.radius),
                 "give a positive number");
  }
  if (c.tube_radius && !positive(*c.tube_radius)) {
    return error("constraint-value"_id,
                 fmt::format("the tube_radius to keep is {} mm", *c.tube_radius),
                 "give a positive number");
  }
  if (c.radius && c.tube_radius && *c.tube_radius >= *c.radius) {
    return error("constraint-value"_id,
                 fmt::format("a tube of radius {} mm about a circle of radius {} mm cuts itself",
                             *c.tube_radius, *c.radius),
                 "tube_radius is smaller than radius");
  }
  if (c.half_angle && !(*c.half_angle > 0.0 && *c.half_angle < std::numbers::pi / 2.0)) {
    return error("constraint-value"_id,
                 fmt::format("the half_angle to keep is {} rad", *c.half_angle),
                 "half angles of cones are between 0 and 90 deg");
  }
  if (c.axis && !c.axis->point.allFinite()) {
    return error("constraint-value"_id, "the axis to keep is not finite",
                 "give finite coordinates");
  }
  return std::nullopt;
}

std::optional<Diagnostic> contradicting(const Constraints& c) {
  const auto contradiction = [](std::string_view a, std::string_view b) {
    return error("constraints-contradict"_id, fmt::format("{} and {} contradict each other", a, b),
                 "leave out one of them");
  };
  if (c.parallel_to && c.perpendicular_to &&
      std::abs(c.parallel_to->vec().dot(c.perpendicular_to->vec())) > kSameDirection) {
    return contradiction("parallel_to", "perpendicular_to");
  }
  if (c.axis && c.perpendicular_to &&
      std::abs(c.axis->axis.vec().dot(c.perpendicular_to->vec())) > kSameDirection) {
    return contradiction("axis", "perpendicular_to");
  }
  if (c.axis && c.parallel_to &&
      c.axis->axis.vec().cross(c.parallel_to->vec()).norm() > kSameDirection) {
    return contradiction("axis", "parallel_to");
  }
  return std::nullopt;
}

// The direction that the constraints leave no choice about.
std::optional<UnitVec3> fixed_direction(const Constraints& c) {
  return c.axis ? std::optional(c.axis->axis) : c.parallel_to;
}

bool is_fixed(Parameter parameter, const Constraints& c) {
  switch (parameter) {
    case Parameter::shift_u:
    case Parameter::shift_v:
      return c.axis.has_value();
    case Parameter::tilt_u:
    case Parameter::tilt_v:
      return c.axis || c.parallel_to;
    case Parameter::radius:
      return c.radius.has_value();
    case Parameter::tube_radius:
      return c.tube_radius.has_value();
    case Parameter::half_angle:
      return c.half_angle.has_value();
    case Parameter::shift_along:
    case Parameter::shift_x:
    case Parameter::shift_y:
    case Parameter::shift_z:
      break;
  }
  return false;
}

UnitVec3 kept_direction(const UnitVec3& axis, const Constraints& c) {
  if (const auto fixed = fixed_direction(c)) {
    return axis.vec().dot(fixed->vec()) < 0.0 ? -*fixed : *fixed;
  }
  if (!c.perpendicular_to) return axis;
  const Vec3& d = c.perpendicular_to->vec();
  const Vec3 lying = axis.vec() - axis.vec().dot(d) * d;
  return UnitVec3::of(lying).value_or(unit(perpendicular_to(d)));
}

}  // namespace

std::optional<Diagnostic> refused(const Constraints& constraints, ElementKind kind,
                                  std::string_view what) {
  if (auto problem = lacking(constraints, kind, what)) return problem;
  if (auto problem = senseless(constraints)) return problem;
  return contradicting(constraints);
}

StepBasis allowed_steps(const Element& element, const Constraints& constraints) {
  const std::span<const Parameter> parameters = parameters_of(kind_of(element));
  const auto n = static_cast<Eigen::Index>(parameters.size());
  const bool one_tilt = constraints.perpendicular_to && !fixed_direction(constraints);
  StepBasis basis = StepBasis::Zero(n, n);
  Eigen::Index columns = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Parameter parameter = parameters[static_cast<std::size_t>(i)];
    if (is_fixed(parameter, constraints)) continue;
    if (one_tilt && parameter == Parameter::tilt_v) continue;
    if (one_tilt && parameter == Parameter::tilt_u) {
      // About the direction it is perpendicular to: toward direction x axis.
      const UnitVec3& axis = *axis_of(element);
      const auto [u, v] = tangents(axis);
      const UnitVec3 toward = unit(constraints.perpendicular_to->vec().cross(axis.vec()));
      basis(i, columns) = toward.vec().dot(u);
      basis(i + 1, columns) = toward.vec().dot(v);  // tilt_v follows tilt_u in every kind
    } else {
      basis(i, columns) = 1.0;
    }
    ++columns;
  }
  return basis.leftCols(columns);
}

Element constrained(const Element& element, const Constraints& constraints) {
  return std::visit(
      [&](auto e) -> Element {
        if constexpr (requires { e.axis; }) e.axis = kept_direction(e.axis, constraints);
        if (constraints.axis) {
          const Line& line = *constraints.axis;
          e.point = line.point + (e.point - line.point).dot(line.axis.vec()) * line.axis.vec();
        }
        if constexpr (requires { e.radius; }) e.radius = constraints.radius.value_or(e.radius);
        if constexpr (requires { e.tube_radius; }) {
          e.tube_radius = constraints.tube_radius.value_or(e.tube_radius);
        }
        if constexpr (requires { e.half_angle; }) {
          e.half_angle = constraints.half_angle.value_or(e.half_angle);
        }
        return e;
      },
      element);
}

}  // namespace frustum::metrology

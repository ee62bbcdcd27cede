// Radius, diameter and half angle.
#include "metrology/characteristic/evaluators.hpp"

namespace frustum::metrology {
namespace {

Evaluated size_of_element(const Toleranced& what, double factor) {
  const FittedFeature& feature = *what.features.front();
  double radius = 0.0;
  if (const auto* cone = std::get_if<Cone>(&feature.element)) {
    // The section perpendicular to the measured axis through the nominal point.
    radius = cone->section_radius((feature.planned->point - cone->point).dot(cone->axis.vec()));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&feature.element)) {
    radius = cylinder->radius;
  } else if (const auto* sphere = std::get_if<Sphere>(&feature.element)) {
    radius = sphere->radius;
  } else {
    radius = std::get<Circle>(feature.element).radius;
  }
  return {factor * radius, factor * feature.planned->radius};
}

}  // namespace

Result<Evaluated> evaluate_radius(const Toleranced& what) { return size_of_element(what, 1.0); }

Result<Evaluated> evaluate_diameter(const Toleranced& what) { return size_of_element(what, 2.0); }

Result<Evaluated> evaluate_half_angle(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  return Evaluated{std::get<Cone>(feature.element).half_angle, feature.planned->half_angle};
}

}  // namespace frustum::metrology

#include "metrology/uncertainty/element_patterns.hpp"

#include <vector>

#include "core/linear_algebra.hpp"
#include "metrology/plan/nominal.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// Directions u, v are tangents(axis).
enum class ElementChange { lift, shift_u, shift_v, tilt_u, tilt_v, radius, half_angle };

std::vector<ElementChange> changes_of(const Element& element) {
  using enum ElementChange;
  switch (kind_of(element)) {
    case ElementKind::plane:
      return {lift, tilt_u, tilt_v};
    case ElementKind::circle:
      return {shift_u, shift_v, radius};  // its plane is fitted on its own
    case ElementKind::cylinder:
      return {shift_u, shift_v, tilt_u, tilt_v, radius};
    case ElementKind::cone:
      return {shift_u, shift_v, tilt_u, tilt_v, radius, half_angle};
    case ElementKind::sphere:
      return {shift_u, shift_v, lift, radius};
    case ElementKind::line:
    case ElementKind::torus:  // no plan has one
      break;
  }
  return {};
}

// The element with one parameter changed `by` so many mm or rad.
Element varied(Element element, ElementChange change, double by) {
  using enum ElementChange;
  std::visit(
      [&](auto& e) {
        if constexpr (requires { e.axis; }) {
          const auto [u, v] = tangents(e.axis);
          const bool along_u = change == shift_u || change == tilt_u;
          const Vec3 across = by * (along_u ? u : v);
          if (change == lift) e.point += by * e.axis.vec();
          if (change == shift_u || change == shift_v) e.point += across;
          if (change == tilt_u || change == tilt_v) e.axis = unit(e.axis.vec() + across);
          if constexpr (requires { e.radius; }) {
            if (change == radius) e.radius += by;
          }
          if constexpr (requires { e.half_angle; }) {
            if (change == half_angle) e.half_angle += by;
          }
        } else {  // a sphere
          if (change == shift_u) e.point.x() += by;
          if (change == shift_v) e.point.y() += by;
          if (change == lift) e.point.z() += by;
          if (change == radius) e.radius += by;
        }
      },
      element);
  return element;
}

// Half the step of a central difference in that parameter, mm or rad.
double step_of(ElementChange change) {
  // All is smooth over 10 mm and 1 rad: these are wrong by 1e-8, rounding adds 1e-9.
  using enum ElementChange;
  return change == tilt_u || change == tilt_v || change == half_angle ? 1e-5 : 1e-3;
}

// Offset and slope along the normal of its surface.
Eigen::MatrixXd motions_of_line(const FittedFeature& feature) {
  const Vec3 along = *axis_of(feature.element);
  Eigen::MatrixXd motions(feature.points.size(), 2);
  for (Eigen::Index i = 0; i < motions.rows(); ++i) {
    const Vec3& p = feature.points[static_cast<std::size_t>(i)].point;
    motions.row(i) << 1.0, (p - point_of(feature.element)).dot(along);
  }
  return motions;
}

// Nothing is fitted to a ruled surface, but characteristics take means of its lines, and lay all of
// it into place.
Eigen::MatrixXd motions_of_lines(const FittedFeature& feature) {
  const auto lines = static_cast<Eigen::Index>(section_count(*feature.planned));
  Eigen::MatrixXd motions =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(feature.points.size()), 6 + lines);
  Vec3 centre = Vec3::Zero();
  for (const MeasuredPoint& p : feature.points) {
    centre += p.point / static_cast<double>(feature.points.size());
  }
  for (Eigen::Index i = 0; i < motions.rows(); ++i) {
    const MeasuredPoint& p = feature.points[static_cast<std::size_t>(i)];
    motions.row(i).head<3>() = p.normal;
    motions.row(i).segment<3>(3) = (p.point - centre).cross(p.normal);
    motions(i, 6 + static_cast<Eigen::Index>(p.section)) = 1.0;
  }
  return motions;
}

}  // namespace

Eigen::MatrixXd element_patterns(const FittedFeature& feature) {
  if (feature.planned->kind == FeatureKind::line) {
    return orthonormal_columns(motions_of_line(feature));
  }
  if (feature.planned->kind == FeatureKind::ruled) {
    return orthonormal_columns(motions_of_lines(feature));
  }
  std::vector<ElementChange> changes = changes_of(feature.element);
  // One touch does not turn its plane.
  if (feature.planned->kind == FeatureKind::point) changes = {ElementChange::lift};
  Eigen::MatrixXd motions(feature.points.size(), changes.size());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const ElementChange change = changes[static_cast<std::size_t>(k)];
    const double step = step_of(change);
    const Element less = varied(feature.element, change, -step);
    const Element more = varied(feature.element, change, step);
    for (Eigen::Index i = 0; i < motions.rows(); ++i) {
      const Vec3& p = feature.points[static_cast<std::size_t>(i)].point;
      motions(i, k) = (residual(less, p) - residual(more, p)) / (2.0 * step);
    }
  }
  // Out of the material of a hole is toward its axis.
  return orthonormal_columns(material_sign(*feature.planned) * motions);
}

}  // namespace frustum::metrology

#include "metrology/uncertainty/fit_response.hpp"

#include <Eigen/Core>

#include "core/linear_algebra.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

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

}  // namespace

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

FittedFeature varied(const FittedFeature& feature, ElementChange change, double by) {
  FittedFeature moved = feature;
  moved.element = varied(feature.element, change, by);
  for (MeasuredPoint& p : moved.points) {
    const double back = residual(feature.element, p.point) - residual(moved.element, p.point);
    p.point += back * outward_normal(moved.element, p.point);
  }
  return moved;
}

double step_of(ElementChange change) {
  // All is smooth over 10 mm and 1 rad: these are wrong by 1e-8, rounding adds 1e-9.
  using enum ElementChange;
  return change == tilt_u || change == tilt_v || change == half_angle ? 1e-5 : 1e-3;
}

FitResponse fit_response(const FittedFeature& feature) {
  FitResponse response{changes_of(feature.element), {}};
  // One touch does not turn its plane.
  if (feature.planned->kind == FeatureKind::point) response.changes = {ElementChange::lift};
  Eigen::MatrixXd jacobian(feature.points.size(), response.changes.size());
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) {
    const ElementChange change = response.changes[static_cast<std::size_t>(k)];
    const double step = step_of(change);
    const Element less = varied(feature.element, change, -step);
    const Element more = varied(feature.element, change, step);
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      const Vec3& p = feature.points[static_cast<std::size_t>(i)].point;
      jacobian(i, k) = (residual(more, p) - residual(less, p)) / (2.0 * step);
    }
  }
  // A point in a hole that moves out of the material moves toward the axis.
  response.weights =
      -material_sign(*feature.planned) * SymmetricFactors(jacobian.transpose() * jacobian)
                                             .solve(Eigen::MatrixXd(jacobian.transpose()));
  return response;
}

}  // namespace frustum::metrology

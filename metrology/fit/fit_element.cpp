#include <fmt/format.h>

#include "core/spelling.hpp"
#include "metrology/fit/least_squares.hpp"

namespace frustum::metrology {
namespace {

template <typename T>
Result<Fit<Element>> widened(Result<Fit<T>> narrow) {
  if (!narrow) return std::move(narrow).error();
  Fit<T>& fit = *narrow;
  return Fit<Element>{fit.element,
                      std::move(fit.residuals),
                      fit.form,
                      fit.rms,
                      std::move(fit.cofactor),
                      std::move(fit.covariance),
                      fit.iterations,
                      fit.condition};
}

}  // namespace

Result<Fit<Element>> fit_element(ElementKind kind, std::span<const Vec3> points,
                                 const FitOptions& options) {
  switch (kind) {
    case ElementKind::line:
      return widened(fit_line(points, options));
    case ElementKind::plane:
      return widened(fit_plane(points, options));
    case ElementKind::circle:
      return widened(fit_circle(points, options));
    case ElementKind::sphere:
      return widened(fit_sphere(points, options));
    case ElementKind::cylinder:
      return widened(fit_cylinder(points, options));
    case ElementKind::cone:
      return widened(fit_cone(points, options));
    case ElementKind::torus:
      break;
  }
  return widened(fit_torus(points, options));
}

Result<Fit<Element>> fit_nearby(ElementKind kind, std::span<const Vec3> points,
                                const FitOptions& options) {
  if (kind == ElementKind::cylinder) return widened(fit_cylinder_nearby(points, options));
  if (kind == ElementKind::cone) return widened(fit_cone_nearby(points, options));
  return fit_element(kind, points, options);
}

Result<Fit<Element>> fit_element(std::string_view name, std::span<const Vec3> points,
                                 const FitOptions& options) {
  if (name == "line2d") return widened(fit_line_2d(points, options));
  if (name == "circle2d") return widened(fit_circle_2d(points, options));
  for (std::size_t i = 0; i < kElementNames.size(); ++i) {
    if (kElementNames[i] == name) return fit_element(static_cast<ElementKind>(i), points, options);
  }
  std::vector<std::string> known(kElementNames.begin(), kElementNames.end());
  known.insert(known.end(), {"line2d", "circle2d"});
  return error("unknown-element"_id, fmt::format("'{}' is not an element", name),
               suggestion(name, known));
}

}  // namespace frustum::metrology

#include <fmt/format.h>

#include "core/spelling.hpp"
#include "metrology/least_squares.hpp"

namespace frustum::metrology {
namespace {

template <typename T>
Result<Fit<Element>> widened(Result<Fit<T>> narrow) {
  if (!narrow) return std::move(narrow).error();
  Fit<T>& fit = *narrow;
  return Fit<Element>{fit.element,   std::move(fit.residuals), fit.form,
                      fit.rms,       std::move(fit.cofactor),  std::move(fit.covariance),
                      fit.iterations};
}

}  // namespace

Result<Fit<Element>> fit_element(ElementKind kind, std::span<const Vec3> points) {
  switch (kind) {
    case ElementKind::line:
      return widened(fit_line(points));
    case ElementKind::plane:
      return widened(fit_plane(points));
    case ElementKind::circle:
      return widened(fit_circle(points));
    case ElementKind::sphere:
      return widened(fit_sphere(points));
    case ElementKind::cylinder:
      return widened(fit_cylinder(points));
    case ElementKind::torus:
      return error("no fit of a torus yet");
    case ElementKind::cone:
      break;
  }
  return widened(fit_cone(points));
}

Result<Fit<Element>> fit_element(std::string_view name, std::span<const Vec3> points) {
  if (name == "circle2d") return widened(fit_circle_2d(points));
  for (std::size_t i = 0; i < kElementNames.size(); ++i) {
    if (kElementNames[i] == name) return fit_element(static_cast<ElementKind>(i), points);
  }
  std::vector<std::string> known(kElementNames.begin(), kElementNames.end());
  known.emplace_back("circle2d");
  return error(fmt::format("'{}' is not an element", name), suggestion(name, known));
}

}  // namespace frustum::metrology

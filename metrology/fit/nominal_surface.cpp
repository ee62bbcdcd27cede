#include "metrology/fit/nominal_surface.hpp"

namespace frustum::metrology {

NominalFoot nearest(const NominalSurface& surface, const Vec3& point) {
  if (const auto* element = std::get_if<Element>(&surface)) {
    return {residual(*element, point), outward_normal(*element, point)};
  }
  const auto& net = std::get<PlacedNet>(surface);
  const SplineFoot foot = net.surface->nearest(net.placed_from_surface.inverse().point(point));
  return {foot.distance, net.placed_from_surface.direction(foot.normal)};
}

double residual(const NominalSurface& surface, const Vec3& point) {
  return nearest(surface, point).distance;
}

Vec3 outward_normal(const NominalSurface& surface, const Vec3& point) {
  return nearest(surface, point).normal;
}

NominalSurface transformed(const Pose& to_from, const NominalSurface& surface) {
  if (const auto* element = std::get_if<Element>(&surface)) return transformed(to_from, *element);
  auto net = std::get<PlacedNet>(surface);
  net.placed_from_surface = to_from * net.placed_from_surface;
  return net;
}

}  // namespace frustum::metrology

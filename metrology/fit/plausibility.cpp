#include "metrology/fit/plausibility.hpp"

#include <numbers>

namespace frustum::metrology {
namespace {

// Bends less than rounding over the part.
constexpr double kStraight = 1e6;

std::optional<std::string> radius_of(double radius, const char* straight, const char* point) {
  if (!(radius > 0.0)) return point;
  if (!(radius < kStraight)) return straight;
  return std::nullopt;
}

std::optional<std::string> reason(const Line&) { return std::nullopt; }

std::optional<std::string> reason(const Plane&) { return std::nullopt; }

std::optional<std::string> reason(const Circle& circle) {
  return radius_of(circle.radius, "the best one is a straight line", "the best one is a point");
}

std::optional<std::string> reason(const Sphere& sphere) {
  return radius_of(sphere.radius, "the best one is a plane", "the best one is a point");
}

std::optional<std::string> reason(const Cylinder& cylinder) {
  return radius_of(cylinder.radius, "the best one is a plane", "the best one is a line");
}

std::optional<std::string> reason(const Cone& cone) {
  // Half angles nearer than 1e-9 to 0 or 90 deg are a cylinder or a plane to rounding.
  if (!(cone.half_angle > 1e-9)) return "the best one is a cylinder";
  if (!(cone.half_angle < std::numbers::pi / 2.0 - 1e-9)) return "the best one is a plane";
  return radius_of(cone.radius, "the best one is a plane", "they are on both sides of its apex");
}

std::optional<std::string> reason(const Torus& torus) {
  if (auto thin =
          radius_of(torus.tube_radius, "the best one is a plane", "the best one is a circle")) {
    return thin;
  }
  if (!(torus.radius < kStraight)) return "the best one is a cylinder";
  if (!(torus.tube_radius < torus.radius)) {
    return "the tube of the best one is so thick that it cuts itself";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> implausible(const Element& element) {
  return std::visit([](const auto& e) { return reason(e); }, element);
}

}  // namespace frustum::metrology

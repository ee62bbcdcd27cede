#include "dynamics/rigid_body.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace frustum::dynamics {
namespace {

// A solid of unit mass about its own centre.
struct UnitSolid {
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

Mat3 steiner(const Vec3& r) { return r.squaredNorm() * Mat3::Identity() - r * r.transpose(); }

// From the second moments about the centre: Ixx = syy + szz, Ixy = -sxy.
Mat3 inertia_of(const Mat3& second_moments) {
  return second_moments.trace() * Mat3::Identity() - second_moments;
}

UnitSolid unit_solid(const SolidBox& box) {
  return {Vec3::Zero(), inertia_of(Mat3((box.size.array().square() / 12.0).matrix().asDiagonal()))};
}

UnitSolid unit_solid(const SolidCylinder& cylinder) {
  const double across = cylinder.diameter * cylinder.diameter / 16.0;
  const double along = cylinder.length * cylinder.length / 12.0;
  return {Vec3::Zero(), inertia_of(Mat3(Vec3(across, across, along).asDiagonal()))};
}

struct Outline {
  double area = 0.0;  // signed
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

// Sums over the triangles from the origin to each side.
Outline moments_of(const std::vector<Eigen::Vector2d>& corners) {
  Outline sum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    const Eigen::Vector2d s = a + b;
    sum.area += area;
    sum.first += area / 3.0 * s;
    sum.second += area / 12.0 * (a * a.transpose() + b * b.transpose() + s * s.transpose());
  }
  return sum;
}

UnitSolid unit_solid(const SolidPrism& prism) {
  const Outline outline = moments_of(prism.outline);
  const Eigen::Vector2d centre = outline.first / outline.area;
  Mat3 second = Mat3::Zero();
  second.topLeftCorner<2, 2>() = outline.second / outline.area - centre * centre.transpose();
  second(2, 2) = prism.length * prism.length / 12.0;
  return {Vec3(centre.x(), centre.y(), 0.0), inertia_of(second)};
}

double volume(const SolidBox& box) { return box.size.prod(); }
double volume(const SolidCylinder& cylinder) {
  return std::numbers::pi / 4.0 * cylinder.diameter * cylinder.diameter * cylinder.length;
}
double volume(const SolidPrism& prism) {
  return std::abs(moments_of(prism.outline).area) * prism.length;
}

}  // namespace

double volume_of(const SolidShape& shape) {
  return std::visit([](const auto& s) { return volume(s); }, shape);
}

bool crosses_itself(const SolidPrism& prism) {
  const auto& corners = prism.outline;
  const std::size_t n = corners.size();
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& p) {
    const Eigen::Vector2d u = b - a, v = p - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    return area > 0.0 ? 1 : (area < 0.0 ? -1 : 0);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k + 1 == n) continue;  // neighbours
      const auto &a = corners[i], &b = corners[i + 1];
      const auto &c = corners[k], &d = corners[(k + 1) % n];
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  }
  return false;
}

RigidBody body_of(std::span<const Solid> solids) {
  RigidBody body{0.0, Vec3::Zero(), Mat3::Zero()};
  std::vector<RigidBody> parts;
  for (const Solid& solid : solids) {
    const UnitSolid unit = std::visit([](const auto& s) { return unit_solid(s); }, solid.shape);
    parts.push_back({solid.mass, solid.at + solid.rotation * unit.centre,
                     solid.mass * solid.rotation * unit.inertia * solid.rotation.transpose()});
    body.mass += parts.back().mass;
    body.centre += parts.back().mass * parts.back().centre;
  }
  body.centre /= body.mass;
  for (const RigidBody& part : parts) {
    body.inertia += part.inertia + part.mass * steiner(part.centre - body.centre);
  }
  return body;
}

std::optional<std::string> impossible_inertia(const Mat3& inertia) {
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string named =
      fmt::format("its principal moments are {:.6g}, {:.6g} and {:.6g} kg m^2", moments[0],
                  moments[1], moments[2]);
  if (!(moments[0] > 0.0)) return named + ", and all must be above 0";
  // Of a rod a thousand times as long as thick 1e-6.
  constexpr double kThinnest = 1e-9;
  if (moments[0] < kThinnest * moments[2]) return named + ", which is a line without thickness";
  // A thin plate has the sum itself, but for the digits in which it is written.
  constexpr double kWrittenDigits = 1e-9;
  if (moments[2] > (moments[0] + moments[1]) * (1.0 + kWrittenDigits)) {
    return named + ", and none may be above the sum of the others";
  }
  return std::nullopt;
}

}  // namespace frustum::dynamics

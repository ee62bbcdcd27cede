// A rigid body: its mass, the centre of its mass and its tensor of inertia, by numbers or as the
// sum of simple solids.
//
// Model    : I = sum over the solids of R I_solid R^T + m (|r|^2 1 - r r^T), r from the common
//            centre to that of the solid (Steiner). Entries of the tensor: Ixy = - integral x y dm
// Units    : kg, m, kg m^2; centre in the frame of the body's part, tensor about the centre, along
//            the axes of that frame
// Shape    : at least one solid
// Errors   : none; impossible_inertia says why no body has a tensor
// Accuracy : rounding (tests/dynamics/rigid_body_test.cpp)
// Source   : Goldstein, Classical Mechanics, chapter 5; principal moments of a body satisfy the
//            triangle inequality
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.hpp"

namespace frustum::dynamics {

struct RigidBody {
  double mass = 1.0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Identity();
};

// Solids about the centre of their box; a cylinder and a prism extend along z.
struct SolidBox {
  Vec3 size = Vec3::Ones();
};
struct SolidCylinder {
  double diameter = 1.0, length = 1.0;
};
// The corners of its outline in x and y, either way round.
struct SolidPrism {
  std::vector<Eigen::Vector2d> outline{};
  double length = 1.0;
};
using SolidShape = std::variant<SolidBox, SolidCylinder, SolidPrism>;

[[nodiscard]] double volume_of(const SolidShape& shape);  // m^3
// Two sides of its outline that are not neighbours meet.
[[nodiscard]] bool crosses_itself(const SolidPrism& prism);

struct Solid {
  SolidShape shape{};
  double mass = 1.0;
  Vec3 at = Vec3::Zero();            // of its own origin
  Mat3 rotation = Mat3::Identity();  // from its own axes to those of the part
};

[[nodiscard]] RigidBody body_of(std::span<const Solid> solids);

// Why no body has this tensor: it is not positive definite, or one principal moment is above the
// sum of the others.
[[nodiscard]] std::optional<std::string> impossible_inertia(const Mat3& inertia);

}  // namespace frustum::dynamics

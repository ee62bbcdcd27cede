// A body of a machine file: by numbers, or as a list of solids.
//
// Units  : in the file kg, mm, deg, kg m^2, kg/m^3; SI in the body
// Errors : noted in the table's document, with key and line
#pragma once

#include "core/toml_document.hpp"
#include "dynamics/rigid_body.hpp"

namespace frustum::dynamics {

constexpr double kMetresPerMm = 1e-3;

// A point in metres, from mm.
[[nodiscard]] Vec3 point_of(const TomlTable& table, std::string_view key);

// [dynamics.body.X]: mass, com, inertia; or [[dynamics.body.X.element]].
[[nodiscard]] RigidBody read_body(const TomlTable& table);

}  // namespace frustum::dynamics

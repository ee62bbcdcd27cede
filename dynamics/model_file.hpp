// [dynamics] of a machine file: masses, springs, dampers and controls.
//
// Units  : in the file mm, deg, kg, kg m^2, N/um, kN s/m, of rotary axes N m/rad and N m s/rad;
//          kv 1/s, kp kN s/m or N m s/rad, tn ms; SI in the model
// Errors : every mistake with key and line: keys that are missing, unknown or no numbers, masses
//          and stiffnesses below zero or so large that they are in another unit, tensors that no
//          body has, a normal that is not across its axis, bearings of a linear axis, and, in the
//          position that the machine starts in, a body that nothing holds in some direction
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/result.hpp"
#include "dynamics/dynamic_model.hpp"

namespace frustum::dynamics {

// Nothing where the file has no [dynamics].
[[nodiscard]] Result<std::optional<DynamicModel>> load_model(const std::filesystem::path& file,
                                                             const kinematics::Machine& machine);
[[nodiscard]] Result<std::optional<DynamicModel>> read_model(std::string_view text,
                                                             const std::filesystem::path& file,
                                                             const kinematics::Machine& machine);

// Where the dynamics of a machine is asked for that states none.
[[nodiscard]] Diagnostic no_dynamics(const kinematics::Machine& machine,
                                     const std::filesystem::path& file);

}  // namespace frustum::dynamics

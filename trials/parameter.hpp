// What a study may vary: one machine error, or the radius of the tools.
//
// Units: an angular parameter in rad, the others in mm.
// Errors: a name that the machine does not accept, or that is given twice.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::trials {

// The name of the radius error that all tools share.
inline constexpr std::string_view kToolRadius = "tool_radius_error";

struct Parameter {
  std::string name{};  // ISO 230-1, an alias of the machine, or kToolRadius
  bool angular = false;
  // One mm or rad of the error, constant over the travel; absent for the tool radius.
  std::optional<kinematics::GeometricErrors> unit{};

  [[nodiscard]] static Result<Parameter> named(const kinematics::Machine& machine,
                                               const std::string& name);
};

// All of them; every unknown name is reported.
[[nodiscard]] Result<std::vector<Parameter>> parameters_named(const kinematics::Machine& machine,
                                                              std::span<const std::string> names);

// The machine's aliases, the tool radius, and the machine's location errors under their ISO names.
[[nodiscard]] std::vector<std::string> constant_errors(const kinematics::Machine& machine);

}  // namespace frustum::trials

// The errors that people write, laid over the axes of one machine.
//
// Model    : each entry names an error of the machine, by its ISO name or an alias; its shapes are
//            over their own span, the default span of the axis, or its travel
// Units    : mm, rad
// Errors   : the error, what is wrong with it and what the machine accepts
// Source   : ISO 230-1 names; ETH thesis sections 3.8 and 3.9 for the spans
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/result.hpp"
#include "kinematics/errors/error_shape.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// Default spans of shapes, by axis; axes not named use their travel.
using AxisSpans = std::map<AxisLetter, AxisRange>;

// What is wrong with a name that no error of the machine has.
[[nodiscard]] std::optional<Diagnostic> unknown_error(const Machine& machine,
                                                      const std::string& name);

// What of an entry's shapes does not fit its error: units of amounts and positions, a shape of a
// location error, an axis that the machine has not. Amounts may still be distributions.
[[nodiscard]] Diagnostics unfit_shapes(const Machine& machine, const ErrorEntry& entry);

// Later entries replace earlier ones of the same error. Amounts that are drawn from distributions
// must have been drawn before (kinematics/errors/error_draw.hpp).
[[nodiscard]] Result<GeometricErrors> resolve(const Machine& machine,
                                              std::span<const ErrorEntry> entries,
                                              const AxisSpans& spans = {});

}  // namespace frustum::kinematics

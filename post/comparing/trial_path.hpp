// The tool paths of supposed programs, and whether they agree with the one that is right.
//
// Units  : mm, rad
// Errors : none; no path where the controller refuses the program
#pragma once

#include <optional>
#include <span>

#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "post/comparing/path_difference.hpp"

namespace frustum::post {

// How close the samples of a path are. Coarse ones are exact where they are, with longer straight
// lines between: enough to see that a path goes elsewhere.
enum class PathSampling : std::uint8_t { coarse, fine };

[[nodiscard]] std::optional<kinematics::CommandedProgram> commanded_or_nothing(
    const kinematics::Machine& machine, const kinematics::Setup& setup,
    std::span<const parser::Motion> motions);

[[nodiscard]] kinematics::ToolPath path_of(const kinematics::Machine& machine,
                                           const kinematics::Setup& setup,
                                           const kinematics::CommandedProgram& commanded,
                                           const kinematics::GeometricErrors& errors,
                                           PathSampling sampling, const DifferenceLimits& limits);
// On the machine without errors.
[[nodiscard]] std::optional<kinematics::ToolPath> path_of(const kinematics::Machine& machine,
                                                          const kinematics::Setup& setup,
                                                          std::span<const parser::Motion> motions,
                                                          PathSampling sampling,
                                                          const DifferenceLimits& limits);

[[nodiscard]] bool lies_on(const kinematics::ToolPath& path, const kinematics::ToolPath& first,
                           const DifferenceLimits& limits);
[[nodiscard]] bool same_way(const kinematics::ToolPath& first, const kinematics::ToolPath& second,
                            const DifferenceLimits& limits);

}  // namespace frustum::post

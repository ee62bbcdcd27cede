// What a run of a program moves the tool by besides its errors, by places of the program before the
// correction.
//
// Model  : the deviation of masses and springs (dynamics/path_deviation.hpp) at each pose of a run,
//          by the block that the pose comes from and its u, linear in between. A program that has
//          been corrected runs otherwise than before: what it is corrected for is found again from
//          its own run. Axes that are shifted faster than the machine's first natural frequency f
//          would shake it more than it deviates: from the deviation over time that is taken off
//          which is slow, s + s - s s with s the mean weighted by a triangle of 2/f to either side:
//          1e-4 is left at f/30, half at f/6, all from f/2 on
// Units  : mm, rad; frame: table
// Errors : of a run: an unstable control, a block that the sources do not name
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calibration/compensate/compensation.hpp"
#include "core/result.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::calibration {

class PathShift {
 public:
  PathShift() = default;  // none

  // The run of `program`, whose blocks come from `sources`; empty: its blocks are its own.
  [[nodiscard]] static Result<PathShift> of_run(const kinematics::Machine& machine,
                                                const kinematics::GeometricErrors& errors,
                                                const kinematics::Setup& setup,
                                                const kinematics::CommandedProgram& program,
                                                std::span<const SourceSpan> sources,
                                                const CompensationOptions& options);

  // Where the errors have to take the tool, so that with the deviation it is at `wanted`.
  [[nodiscard]] kinematics::ToolPose before(const kinematics::ToolPose& wanted, std::uint32_t block,
                                            double u) const;
  // mm: the largest distance of the tip's deviations.
  [[nodiscard]] double distance_from(const PathShift& other) const;

 private:
  struct Place {
    double u = 0.0;
    Vec3 tip = Vec3::Zero();
    Vec3 turn = Vec3::Zero();
  };
  [[nodiscard]] Place at(std::uint32_t block, double u) const;

  std::vector<std::vector<Place>> blocks_{};
};

}  // namespace frustum::calibration

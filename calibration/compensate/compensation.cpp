#include "calibration/compensate/compensation.hpp"

#include <algorithm>
#include <utility>

#include "calibration/compensate/compensation_proof.hpp"
#include "calibration/compensate/corrected_program.hpp"
#include "kinematics/controller/controller.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::Setup;
using kinematics::ToolPath;
using kinematics::ToolPose;
using parser::Motion;

// Where the axes are commanded to, on the machine as it is and as it should be.
PathError without_correction(const Machine& machine, const Setup& setup, const ToolPath& actual) {
  const Pose workpiece_from_table = setup.table_from_workpiece.inverse();
  PathError error;
  for (const kinematics::PathSegment& segment : actual.segments) {
    const PathBlock& block = actual.blocks[segment.block];
    if (block.kind != PathKind::feed) continue;
    const std::uint32_t end = segment.first_pose + 1;
    const kinematics::ToolGeometry& tool = setup.tools.at(block.tool);
    const ToolPose wanted = kinematics::tool_pose(
        workpiece_from_table *
        kinematics::nominal_pose(machine, actual.axes[end].q, tool.length + tool.length_error));
    error.tip = std::max(error.tip, (actual.poses[end].tip - wanted.tip).norm());
    error.axis = std::max(error.axis, angle_between(actual.poses[end].axis, wanted.axis));
  }
  return error;
}

}  // namespace

Result<CompensatedProgram> compensated(const Machine& machine, const GeometricErrors& errors,
                                       const Setup& setup, std::span<const Motion> motions,
                                       const CompensationOptions& options) {
  const auto commanded = kinematics::command(machine, setup, motions);
  if (!commanded) return commanded.error();
  auto result = corrected(machine, errors, setup, motions, *commanded, options);
  if (!result) return result;
  const auto written = kinematics::command(machine, setup, result->motions);
  if (!written) return written.error();
  const auto proof = prove(machine, errors, setup, *commanded, *written, result->sources, options);
  if (!proof) return proof.error();
  result->after = proof->beside;
  result->at_turns = proof->at_turns;
  return result;
}

Result<CompensatedProgram> corrected(const Machine& machine, const GeometricErrors& errors,
                                     const Setup& setup, std::span<const Motion> motions,
                                     const kinematics::CommandedProgram& commanded,
                                     const CompensationOptions& options) {
  if (options.run.servo_lag && options.run.has_dynamics()) {
    return error("conflicting-keys"_id,
                 "dynamics cannot be compensated together with servo_lag: the axes are elsewhere "
                 "than commanded",
                 "remove servo_lag from the job's [controller]");
  }
  trials::TrialOptions run = options.run;
  run.path_bound = 0.5 * options.bound;
  const auto before = trials::tool_travel(machine, errors, setup, commanded, run);
  if (!before) return before.error();
  auto shift = PathShift::of_run(machine, errors, setup, commanded, {}, options);
  if (!shift) return shift.error();
  auto program = corrected_program(machine, errors, setup, motions, commanded, options, *shift);
  if (!program) return program.error();
  // Short blocks and shifted places run otherwise than the program before; it settles at once.
  constexpr int kMostRuns = 4;
  for (int k = 0; options.run.has_dynamics() && k < kMostRuns; ++k) {
    const auto written = kinematics::command(machine, setup, program->motions);
    if (!written) return written.error();
    auto next = PathShift::of_run(machine, errors, setup, *written, program->sources, options);
    if (!next) return next.error();
    if (next->distance_from(*shift) < 0.25 * options.bound) break;
    shift = std::move(next);
    program = corrected_program(machine, errors, setup, motions, commanded, options, *shift);
    if (!program) return program.error();
  }
  return CompensatedProgram{.motions = std::move(program->motions),
                            .sources = std::move(program->sources),
                            .before = without_correction(machine, setup, before->path)};
}

}  // namespace frustum::calibration

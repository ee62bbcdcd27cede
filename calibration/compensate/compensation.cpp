#include "calibration/compensate/compensation.hpp"

#include <algorithm>
#include <utility>

#include "calibration/compensate/compensation_proof.hpp"
#include "calibration/compensate/corrected_program.hpp"
#include "kinematics/controller/controller.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/path/travel.hpp"

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
  auto program = corrected_program(machine, errors, setup, motions, commanded, options);
  if (!program) return program.error();
  const kinematics::TravelOptions sampling{.path_bound = 0.5 * options.bound};
  return CompensatedProgram{
      .motions = std::move(program->motions),
      .sources = std::move(program->sources),
      .before = without_correction(
          machine, setup, kinematics::travel(machine, setup, commanded, errors, sampling).path)};
}

}  // namespace frustum::calibration

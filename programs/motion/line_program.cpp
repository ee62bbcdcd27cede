#include <fmt/format.h>

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "programs/motion/motion_blocks.hpp"

namespace frustum::programs {

Vec3 line_origin(const kinematics::Machine& machine, double tool_length) {
  return nominal_pose(machine, {}, tool_length).translation;
}

Result<TestPiece> line_program(const kinematics::Machine& machine, const std::string& name,
                               const std::string& title,
                               std::span<const instruments::LineTest> runs, double tool_length,
                               const MotionProgramOptions& given) {
  MotionProgramOptions options = given;
  options.form = MotionForm::axes;  // a laser along axes
  MotionBlocks blocks(machine, name == "line" ? "5005" : "5006", title,
                      line_origin(machine, tool_length), tool_length, options);
  blocks.comment(fmt::format("T1 IS THE REFLECTOR, LENGTH {:g} MM", tool_length));
  for (const instruments::LineTest& run : runs) {
    if (!within_travel(machine, run.start)) {
      return error("axis-overtravel"_id,
                   fmt::format("the overrun before the first target cannot be reached: {}",
                               fmt::join(travel_violations(machine, run.start), "; ")),
                   "leave out the targets at the ends of the travel");
    }
    if (&run == &runs.front()) {
      blocks.begin(run.start);
      blocks.approach(run.start);
      blocks.stop("SET THE LASER");
    } else {
      blocks.feed(run.start);
    }
    for (const instruments::TestPose& pose : run.poses) {
      blocks.feed(pose.at.q);
      blocks.dwell(options.dwell);
    }
  }
  return blocks.end(name, title);
}

}  // namespace frustum::programs

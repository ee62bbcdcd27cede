#include "post/planning/pose_run.hpp"

#include <cmath>
#include <optional>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "post/planning/nearest_plan.hpp"

namespace frustum::post {

using kinematics::AxisPositions;
using kinematics::PlannedPose;
using parser::AxisTarget;

namespace {

bool moves_no_axis(const parser::Command& command) {
  return std::holds_alternative<parser::Event>(command) ||
         std::holds_alternative<parser::SpindleChange>(command) ||
         std::holds_alternative<parser::CoolantChange>(command) ||
         std::holds_alternative<parser::Dwell>(command);
}

struct VectorMove {
  const AxisTarget& end;
  const UnitVec3& tool_axis;
  bool rapid;
};

std::optional<VectorMove> vector_move(const parser::Command& command) {
  if (const auto* move = std::get_if<parser::Traverse>(&command)) {
    if (move->tool_axis && move->coordinates == parser::Coordinates::program) {
      return VectorMove{move->end, *move->tool_axis, true};
    }
  } else if (const auto* feed = std::get_if<parser::LinearFeed>(&command)) {
    if (feed->tool_axis && feed->coordinates == parser::Coordinates::program) {
      return VectorMove{feed->end, *feed->tool_axis, false};
    }
  } else if (const auto* arc = std::get_if<parser::ArcFeed>(&command)) {
    if (arc->tool_axis) return VectorMove{arc->end, *arc->tool_axis, false};
  }
  return std::nullopt;
}

}  // namespace

Vec3 with_words(Vec3 point, const AxisTarget& words) {
  for (const kinematics::AxisLetter letter : kinematics::kLinearAxes) {
    if (words[letter]) point[static_cast<Eigen::Index>(letter)] = *words[letter];
  }
  return point;
}

PoseRun vector_run(std::span<const parser::Motion> motions, Vec3 tip,
                   const Pose& table_from_words) {
  PoseRun run;
  for (const parser::Motion& motion : motions) {
    if (moves_no_axis(motion.command)) continue;
    const auto move = vector_move(motion.command);
    if (!move) break;
    tip = with_words(tip, move->end);
    if (move->rapid) run.through_air.push_back(run.poses.size());
    if (run.poses.empty()) run.from_here = !move->rapid;
    run.poses.push_back({table_from_words.point(tip), table_from_words.direction(move->tool_axis)});
  }
  return run;
}

Result<std::vector<PlannedPose>> choose_axes(const kinematics::Machine& machine, const PoseRun& run,
                                             const AxisPositions& here, double tool_length,
                                             AxisChoice choice, Rad pole_tolerance) {
  kinematics::PlanOptions how{.start = here, .pole_tolerance = pole_tolerance.value};
  how.through_air = run.through_air;
  std::vector<kinematics::ToolPose> path = run.poses;
  if (run.from_here) {
    path.insert(path.begin(),
                kinematics::tool_pose(kinematics::nominal_pose(machine, here, tool_length)));
    for (std::size_t& index : how.through_air) ++index;
  }
  auto planned = choice == AxisChoice::nearest
                     ? nearest_plan(machine, path, tool_length, how)
                     : kinematics::plan_axes(machine, path, tool_length, how);
  if (!planned || !run.from_here) return planned;
  // rad: what rounding of a plan leaves is far below, another solution far above.
  constexpr double kOtherPositions = 1e-3;
  const AxisPositions begins = planned->front().axes;
  planned->erase(planned->begin());
  PlannedPose& first = planned->front();
  if (!first.unwind && rotary_travel(here, begins) > kOtherPositions) {
    first.unwind = true;
    first.resume = begins;
  }
  return planned;
}

double rotary_travel(const AxisPositions& from, const AxisPositions& to) {
  double sum = 0.0;
  for (const kinematics::AxisLetter letter : kinematics::kRotaryAxes) {
    sum += (to[letter] - from[letter]) * (to[letter] - from[letter]);
  }
  return std::sqrt(sum);
}

}  // namespace frustum::post

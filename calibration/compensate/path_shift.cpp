#include "calibration/compensate/path_shift.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/path_deviation.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {

using kinematics::ToolPath;
using kinematics::ToolPose;

Result<PathShift> PathShift::of_run(const kinematics::Machine& machine,
                                    const kinematics::GeometricErrors& errors,
                                    const kinematics::Setup& setup,
                                    const kinematics::CommandedProgram& program,
                                    std::span<const SourceSpan> sources,
                                    const CompensationOptions& options) {
  PathShift shift;
  if (!options.run.has_dynamics()) return shift;
  // Without the deviation: it is asked for by itself.
  trials::TrialOptions still = options.run;
  still.path_bound = 0.5 * options.bound;
  const auto travel = trials::still_travel(machine, errors, setup, program, still);
  if (!travel) return travel.error();
  const ToolPath& path = travel->path;
  const auto deviations =
      pose_deviations(*options.run.dynamic_model, setup, path, options.run.dynamics);
  const Mat3& table_from_workpiece = setup.table_from_workpiece.rotation;
  const auto source_of = [&](std::uint32_t block) {
    return sources.empty() ? SourceSpan{.block = block} : sources[block];
  };
  if (!sources.empty() && sources.size() != path.blocks.size()) {
    return error("compensation-unproven"_id,
                 "the program written has other blocks than its sources", "report this program");
  }
  const auto put = [&](std::uint32_t block, double share, std::size_t pose) {
    const SourceSpan source = source_of(block);
    if (source.block >= shift.blocks_.size()) shift.blocks_.resize(source.block + std::size_t{1});
    std::vector<Place>& places = shift.blocks_[source.block];
    const double u = std::lerp(source.from, source.to, share);
    // Where axes turn, the place waits.
    if (!places.empty() && u <= places.back().u) return;
    places.push_back({u, table_from_workpiece * deviations[pose].tip,
                      table_from_workpiece * deviations[pose].turn});
  };
  std::uint32_t last_block = 0;
  bool first = true;
  for (const kinematics::PathSegment& segment : path.segments) {
    if (first || segment.block != last_block) put(segment.block, 0.0, segment.first_pose);
    put(segment.block, path.shares[segment.first_pose + 1], segment.first_pose + 1);
    last_block = segment.block;
    first = false;
  }
  return shift;
}

PathShift::Place PathShift::at(std::uint32_t block, double u) const {
  if (block >= blocks_.size() || blocks_[block].empty()) return {u};
  const std::vector<Place>& places = blocks_[block];
  const auto after = std::ranges::lower_bound(places, u, {}, &Place::u);
  if (after == places.begin()) return places.front();
  if (after == places.end()) return places.back();
  const Place &a = *std::prev(after), &b = *after;
  const double t = (u - a.u) / (b.u - a.u);
  return {u, a.tip + t * (b.tip - a.tip), a.turn + t * (b.turn - a.turn)};
}

ToolPose PathShift::before(const ToolPose& wanted, std::uint32_t block, double u) const {
  if (blocks_.empty()) return wanted;
  const Place moved = at(block, u);
  return {wanted.tip - moved.tip, (wanted.axis - moved.turn.cross(wanted.axis)).normalized()};
}

double PathShift::distance_from(const PathShift& other) const {
  double most = 0.0;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (const Place& place : blocks_[block]) {
      const Place there = other.at(static_cast<std::uint32_t>(block), place.u);
      most = std::max(most, (place.tip - there.tip).norm());
    }
  }
  return most;
}

}  // namespace frustum::calibration

#include "calibration/compensate/path_shift.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/modes.hpp"
#include "dynamics/path_deviation.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {

using kinematics::ToolPath;
using kinematics::ToolPose;

namespace {

using dynamics::PoseDeviation;
using Row = Eigen::Matrix<double, 6, 1>;  // tip, turn

// The running mean over 2 n + 1 samples; at the ends of what is there.
std::vector<Row> mean_of(const std::vector<Row>& rows, std::size_t n) {
  std::vector<Row> sums{Row::Zero()};
  for (const Row& row : rows) sums.push_back(sums.back() + row);
  std::vector<Row> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // Even on both sides, so that the ends stay where they are.
    const std::size_t reach = std::min({n, i, rows.size() - 1 - i});
    means.push_back((sums[i + reach + 1] - sums[i - reach]) / static_cast<double>(2 * reach + 1));
  }
  return means;
}

std::vector<Row> slow_part(const std::vector<Row>& rows, std::size_t n) {
  const auto smoothed = [n](const std::vector<Row>& all) { return mean_of(mean_of(all, n), n); };
  std::vector<Row> once = smoothed(rows);
  const std::vector<Row> twice = smoothed(once);
  for (std::size_t i = 0; i < once.size(); ++i) once[i] += once[i] - twice[i];
  return once;
}

// What shifted axes can take off of the deviations at the poses of a path.
std::vector<PoseDeviation> slow_deviations(const ToolPath& path,
                                           const std::vector<PoseDeviation>& deviations,
                                           double first_frequency) {
  constexpr double kStep = 1e-3;  // s
  std::vector<PoseDeviation> slow = deviations;
  if (path.times.size() < 2) return slow;
  const double from = path.times.front();
  const auto count = static_cast<std::size_t>((path.times.back() - from) / kStep) + 2;
  std::vector<Row> even;
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double time = from + static_cast<double>(k) * kStep;
    while (i + 2 < path.times.size() && path.times[i + 1] <= time) ++i;
    const double span = path.times[i + 1] - path.times[i];
    const double t = span > 0.0 ? std::clamp((time - path.times[i]) / span, 0.0, 1.0) : 1.0;
    const PoseDeviation &a = deviations[i], &b = deviations[i + 1];
    Row row;
    row << a.tip + t * (b.tip - a.tip), a.turn + t * (b.turn - a.turn);
    even.push_back(row);
  }
  const double half_width = 1.0 / first_frequency;  // s, of each of the two means
  const std::vector<Row> found =
      slow_part(even, static_cast<std::size_t>(std::max(1.0, half_width / kStep)));
  for (std::size_t pose = 0; pose < slow.size(); ++pose) {
    const double place = (path.times[pose] - from) / kStep;
    const auto below = std::min(static_cast<std::size_t>(place), found.size() - 2);
    const Row row =
        found[below] + (place - static_cast<double>(below)) * (found[below + 1] - found[below]);
    slow[pose] = {row.head<3>(), row.tail<3>()};
  }
  return slow;
}

}  // namespace

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
  // What is slow is the same without vibrations, but for loops, which lag.
  const dynamics::DynamicModel& model = *options.run.dynamic_model;
  if (!model.is_controlled()) {
    constexpr double kLeastStep = 2e-3;  // s, as of jobs that ask for it
    still.dynamics.method = dynamics::PathMethod::quasi_static;
    still.dynamics.time_step = std::max(still.dynamics.time_step, kLeastStep);
  }
  const auto travel = trials::still_travel(machine, errors, setup, program, still);
  if (!travel) return travel.error();
  const ToolPath& path = travel->path;
  const double first_frequency = natural_frequencies(structure_at(model, program.start, 0.0))[0];
  const std::vector<PoseDeviation> deviations =
      slow_deviations(path, pose_deviations(model, setup, path, still.dynamics), first_frequency);
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

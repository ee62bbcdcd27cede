#include "app/player/played_path.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "app/job/trial_run.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/path/path_comparison.hpp"

namespace frustum::app {
namespace {

using kinematics::ToolPath;

constexpr double kFramesOfAProgram = 3000.0;  // what a time line of a screen can show
constexpr double kLeastStep = 0.01;           // s: half of what a frame of a film shows
// s: doubles have coordinates of a metre to 1e-13 mm and times of an hour to 5e-13 s, so that a
// feed over more than this is known to a hundred-thousandth.
constexpr double kLeastTimeOfFeed = 1e-7;

// One pose of the path, in the order in which the tool passes them.
struct Kept {
  std::uint32_t pose = 0;
  std::uint32_t block = 0;
  bool starts = false;
  double way = 0.0;  // mm, of the error-free tip from the start of its chain
};

std::vector<Kept> passed(const ToolPath& path) {
  std::vector<Kept> poses;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (const kinematics::PathSegment& segment : path.segments) {
    if (segment.first_pose != last) poses.push_back({segment.first_pose, segment.block, true});
    last = segment.first_pose + 1;
    poses.push_back({last, segment.block, false});
  }
  return poses;
}

// Every so many of the poses within blocks, and of the ends of blocks where these are too many.
std::vector<Kept> thinned(std::vector<Kept> poses, std::size_t most) {
  if (poses.size() <= most) return poses;
  const auto ends_block = [&](std::size_t k) {
    return k + 1 == poses.size() || poses[k + 1].starts || poses[k + 1].block != poses[k].block;
  };
  std::size_t ends = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) ends += ends_block(k) ? 1U : 0U;
  const std::size_t of_ends = 1 + ends / most;
  const std::size_t room = most > ends ? most - ends : 0;
  const std::size_t within = poses.size() - ends;
  std::vector<Kept> kept;
  std::size_t end = 0, inner = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    bool keep = poses[k].starts || k + 1 == poses.size() || poses[k + 1].starts;
    if (ends_block(k)) {
      keep = keep || end % of_ends == 0;
      ++end;
    } else if (room > 0) {
      // As many as there is room for, evenly.
      keep = keep || (inner * room) / within != ((inner + 1) * room) / within;
      ++inner;
    }
    if (keep) kept.push_back(poses[k]);
  }
  return kept;
}

// Tips of the machine without errors, of tools as they are measured.
class ErrorFreeTips {
 public:
  ErrorFreeTips(const kinematics::Machine& machine, const kinematics::Setup& setup)
      : machine_(machine), setup_(setup) {}

  [[nodiscard]] Vec3 at(const kinematics::AxisPositions& axes, int tool) {
    auto chain = chains_.find(tool);
    if (chain == chains_.end()) {
      const double length = setup_.tools.at(tool).length;
      chain = chains_.try_emplace(tool, machine_, none_, length).first;
    }
    return workpiece_from_table_.point(chain->second.table_from_tool(axes).translation);
  }

 private:
  const kinematics::Machine& machine_;
  const kinematics::Setup& setup_;
  kinematics::GeometricErrors none_{};
  Pose workpiece_from_table_ = setup_.table_from_workpiece.inverse();
  std::map<int, kinematics::ForwardChain> chains_{};
};

void add_ways(const ToolPath& path, ErrorFreeTips& tips, std::vector<Kept>& poses) {
  Vec3 last = Vec3::Zero();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vec3 tip = tips.at(path.axes[poses[k].pose].q, path.blocks[poses[k].block].tool);
    if (k > 0 && !poses[k].starts) poses[k].way = poses[k - 1].way + (tip - last).norm();
    last = tip;
  }
}

// What is too short to tell a feed has that of the motion before.
void add_feeds(const std::vector<Kept>& kept, std::vector<PathPoint>& points) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].starts) continue;
    const double time = points[k].time - points[k - 1].time;
    points[k].feed = time < kLeastTimeOfFeed ? points[k - 1].feed
                                             : 60.0 * (kept[k].way - kept[k - 1].way) / time;
  }
}

// The path of the points alone, for a walk beside another one.
ToolPath path_of(const ToolPath& path, const std::vector<Kept>& kept) {
  ToolPath few;
  few.blocks = path.blocks;
  few.bound = path.bound;
  for (const Kept& k : kept) {
    if (!k.starts) {
      few.segments.push_back({static_cast<std::uint32_t>(few.poses.size() - 1), k.block});
    }
    few.poses.push_back(path.poses[k.pose]);
    few.axes.push_back(path.axes[k.pose]);
    few.times.push_back(path.times[k.pose]);
  }
  return few;
}

// Where the error-free path is nearest to each point, on rapids too.
void compare_by_place(ToolPath few, ToolPath ideal, std::vector<PathPoint>& points) {
  for (ToolPath* path : {&few, &ideal}) {
    for (auto& block : path->blocks) block.kind = kinematics::PathKind::feed;
  }
  const auto matches = kinematics::match_paths(few, ideal).matches;
  for (std::size_t k = 0; k < std::min(matches.size(), points.size()); ++k) {
    points[k].tip = matches[k].other.pose.tip;
    points[k].deviation = few.poses[k].tip - points[k].tip;
  }
}

Result<kinematics::Travel> travelled(const Job& job, const trials::CommandedPiece& commanded,
                                     const kinematics::GeometricErrors& errors,
                                     const PointBudget& budget) {
  trials::TrialOptions options = trial_options_of(job);
  const kinematics::Setup setup = trials::setup_of(job.piece);
  options.path_bound = std::max(job.path_bound, budget.bound);
  for (int attempt = 0;; ++attempt) {
    auto travel = trials::tool_travel(job.machine, errors, setup, commanded.program, options);
    constexpr int kAttempts = 3;
    if (!travel || travel->path.poses.size() <= budget.most || attempt == kAttempts) return travel;
    if (options.servo_lag || options.has_dynamics()) return travel;  // their steps are in time
    options.path_bound *= 16.0;  // a quarter of the points on a curve
  }
}

}  // namespace

Result<PlayedPath> played_path(const Job& job, const trials::CommandedPiece& commanded,
                               const kinematics::GeometricErrors& errors,
                               const PointBudget& budget) {
  const trials::TrialOptions options = trial_options_of(job);
  const kinematics::Setup setup = trials::setup_of(job.piece);
  auto travel = travelled(job, commanded, errors, budget);
  if (!travel) return travel.error();
  PlayedPath played{.by_place = options.servo_lag || options.has_dynamics()};
  const double step = std::max(kLeastStep, travel->cycle_time / kFramesOfAProgram);
  const auto steps = static_cast<std::size_t>(travel->cycle_time / step);
  if (!played.by_place && travel->path.poses.size() + steps <= budget.most) {
    // Speeding up and slowing down within long blocks, too.
    travel = kinematics::travel(
        job.machine, setup, commanded.program, errors,
        {.path_bound = travel->path.bound, .time_law = options.time_law, .time_step = step});
  }
  const ToolPath& path = travel->path;
  ErrorFreeTips tips(job.machine, setup);
  std::vector<Kept> all = passed(path);
  add_ways(path, tips, all);
  const std::vector<Kept> kept = thinned(all, budget.most);
  played.left_out = all.size() - kept.size();
  played.blocks = path.blocks;
  played.cycle_time = travel->cycle_time;
  played.bound = path.bound;
  for (const Kept& k : kept) {
    const kinematics::AxisPositions& axes = path.axes[k.pose].q;
    PathPoint point{.time = path.times[k.pose], .axes = axes, .block = k.block, .starts = k.starts};
    point.tip = tips.at(axes, path.blocks[k.block].tool);
    point.deviation = path.poses[k.pose].tip - point.tip;
    played.points.push_back(point);
  }
  add_feeds(kept, played.points);
  if (played.by_place) {
    kinematics::Setup measured = setup;
    for (auto& [number, tool] : measured.tools) tool.length_error = 0.0;
    auto ideal = kinematics::travel(job.machine, measured, commanded.program,
                                    kinematics::GeometricErrors{}, {.path_bound = 1e-4});
    compare_by_place(path_of(path, kept), std::move(ideal.path), played.points);
  }
  for (const PathPoint& point : played.points) {
    played.largest_deviation = std::max(played.largest_deviation, point.deviation.norm());
  }
  return played;
}

}  // namespace frustum::app

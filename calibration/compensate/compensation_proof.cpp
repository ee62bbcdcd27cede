#include "calibration/compensate/compensation_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "calibration/compensate/leash.hpp"
#include "calibration/compensate/pose_distance.hpp"
#include "calibration/compensate/wanted_block.hpp"
#include "kinematics/path/approach_direction.hpp"

namespace frustum::calibration {
namespace {

using kinematics::CommandedMove;
using kinematics::ToolPath;
using kinematics::ToolPose;

// Of the blocks before and after one; several axes may turn, and back, within the zone of one.
constexpr std::size_t kTurnsBeside = 40;

// The place nearest to a pose on a line of poses.
struct Foot {
  ToolPose pose{};
  std::size_t after = 0;  // the pose of the line that it is at or behind
};

Foot foot_on(const ToolPose& pose, std::span<const ToolPose> line) {
  Foot best{line.front(), 0};
  double least = distance(best.pose, pose);
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const ToolPose foot =
        kinematics::between(line[k], line[k + 1], share_of_way(line[k], line[k + 1], pose));
    if (const double d = distance(foot, pose); d < least) {
      least = d;
      best = {foot, k};
    }
  }
  return best;
}

ToolPose nearest(const ToolPose& pose, std::span<const ToolPose> line) {
  return foot_on(pose, line).pose;
}

void include(PathError& error, const PathError& other) {
  error.tip = std::max(error.tip, other.tip);
  error.axis = std::max(error.axis, other.axis);
}

void include(PathError& error, const ToolPose& actual, const ToolPose& wanted) {
  error.tip = std::max(error.tip, (actual.tip - wanted.tip).norm());
  error.axis = std::max(error.axis, angle_between(actual.axis, wanted.axis));
}

// A place where an axis turns, and how far round it the turn moves the tool.
class Turn {
 public:
  Turn(const ToolPose& place, std::span<const ToolPose> actual) : place_(place) {
    for (const ToolPose& pose : actual) reach_ = std::max(reach_, distance(pose, place));
  }
  [[nodiscard]] bool is_near(const ToolPose& place) const {
    return distance(place, place_) <= reach_;
  }

 private:
  ToolPose place_;
  double reach_ = kTurnZone;
};

// Nominal poses, in the workpiece frame, of the blocks that the spans come from in order.
class NominalSpans {
 public:
  NominalSpans(const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
               const kinematics::Setup& setup, const kinematics::CommandedProgram& nominal,
               double bound)
      : machine_(machine),
        errors_(errors),
        setup_(setup),
        workpiece_from_table_(setup.table_from_workpiece.inverse()),
        bound_(bound) {
    for (const kinematics::CommandedStep& step : nominal.steps) {
      const auto* move = std::get_if<CommandedMove>(&step);
      if (move != nullptr && move->tool != 0) moves_.push_back(move);
    }
  }

  [[nodiscard]] std::vector<ToolPose> poses(const SourceSpan& span) {
    const WantedBlock& block = block_of(span.block);
    std::vector<ToolPose> poses{at(block, span.from)};
    if (span.to <= span.from) return poses;
    for (const double u : block.samples_between(span.from, span.to)) poses.push_back(at(block, u));
    poses.push_back(at(block, span.to));
    return poses;
  }

 private:
  const WantedBlock& block_of(std::uint32_t index) {
    if (!block_ || index != index_) {
      const CommandedMove& move = *moves_[index];
      const kinematics::ToolGeometry& tool = setup_.tools.at(move.tool);
      block_.emplace(machine_, errors_, move.motion, tool.length + tool.length_error,
                     tool.flute_length, bound_);
      index_ = index;
    }
    return *block_;
  }
  [[nodiscard]] ToolPose at(const WantedBlock& block, double u) const {
    const ToolPose in_table = block.pose(u);
    return {workpiece_from_table_.point(in_table.tip),
            workpiece_from_table_.direction(in_table.axis)};
  }

  const kinematics::Machine& machine_;
  const kinematics::GeometricErrors& errors_;
  const kinematics::Setup& setup_;
  Pose workpiece_from_table_;
  double bound_;
  std::vector<const CommandedMove*> moves_{};
  std::optional<WantedBlock> block_{};
  std::uint32_t index_ = 0;
};

// Tip and axis of poses, each by itself.
struct Lines {
  std::vector<Vec3> tips{}, axes{};

  void add(const ToolPose& pose) {
    tips.push_back(pose.tip);
    axes.push_back(pose.axis);
  }
};

// Feed moves without an interruption, and how far off the tool is where axes turn. It may be early
// or late there, too, but does not go back on the nominal path: tool and place are walked along
// together, from a place beside the turns to the next one.
class FeedRun {
 public:
  // The nominal poses of the next block.
  void add_wanted(std::span<const ToolPose> poses) {
    block_ = wanted_.size();
    wanted_.insert(wanted_.end(), poses.begin(), poses.end());
  }
  // Of the actual tool in that block; its place is that nearest to it in the block.
  void pass(const ToolPose& tool, const Foot& place, bool turning) {
    passed_.push_back({tool, {place.pose, block_ + place.after}, turning});
  }

  [[nodiscard]] PathError at_turns() const {
    PathError error;
    for (std::size_t k = 0; k < passed_.size(); ++k) {
      if (!passed_[k].turning) continue;
      const std::size_t first = k - std::min<std::size_t>(k, 1);
      while (k + 1 < passed_.size() && passed_[k].turning) ++k;
      const Lines tool = tool_between(first, k), places = places_between(first, k);
      error.tip = std::max(error.tip, leash_of_places(tool.tips, places.tips));
      error.axis = std::max(error.axis, leash_of_directions(tool.axes, places.axes));
    }
    return error;
  }

 private:
  struct Passed {
    ToolPose tool{};
    Foot place{};  // of the run
    bool turning = false;
  };

  [[nodiscard]] Lines tool_between(std::size_t first, std::size_t last) const {
    Lines lines;
    for (std::size_t k = first; k <= last; ++k) lines.add(passed_[k].tool);
    return lines;
  }
  [[nodiscard]] Lines places_between(std::size_t first, std::size_t last) const {
    // A run begins and ends where it should, whatever turns there.
    const Foot from = passed_[first].turning ? Foot{wanted_.front(), 0} : passed_[first].place;
    const Foot to =
        passed_[last].turning ? Foot{wanted_.back(), wanted_.size() - 1} : passed_[last].place;
    Lines lines;
    lines.add(from.pose);
    for (std::size_t k = from.after + 1; k <= to.after; ++k) lines.add(wanted_[k]);
    lines.add(to.pose);
    return lines;
  }

  std::vector<ToolPose> wanted_{};
  std::size_t block_ = 0;  // where the last one begins
  std::vector<Passed> passed_{};
};

// The poses of one block of a path, and those from which an error jumps to the next one.
struct ActualBlock {
  std::vector<ToolPose> poses{};
  std::vector<std::size_t> jumps{};
};

// Whether an axis turns while all stand. Where two blocks meet, positions differ by rounding.
bool jumps(const kinematics::AxisState& from, const kinematics::AxisState& to) {
  return !(from.heading == to.heading) &&
         std::ranges::all_of(kinematics::kAxisLetters, [&](kinematics::AxisLetter axis) {
           return std::abs(to.q[axis] - from.q[axis]) <= kinematics::least_motion(axis);
         });
}

std::vector<ActualBlock> actual_blocks(const ToolPath& path) {
  std::vector<ActualBlock> blocks(path.blocks.size());
  for (const kinematics::PathSegment& segment : path.segments) {
    ActualBlock& block = blocks[segment.block];
    if (block.poses.empty()) block.poses.push_back(path.from(segment));
    if (jumps(path.axes[segment.first_pose], path.axes[segment.first_pose + 1])) {
      block.jumps.push_back(block.poses.size() - 1);
    }
    block.poses.push_back(path.to(segment));
  }
  return blocks;
}

// Where axes turn in one block.
std::vector<Turn> turns_of(const SourceSpan& source, std::span<const ToolPose> wanted,
                           const ActualBlock& actual) {
  std::vector<Turn> turns;
  if (source.turn) turns.emplace_back(wanted.front(), actual.poses);
  for (const std::size_t k : actual.jumps) {
    turns.emplace_back(nearest(actual.poses[k], wanted), std::span(actual.poses).subspan(k, 2));
  }
  return turns;
}

}  // namespace

Result<CompensationProof> prove(const kinematics::Machine& machine,
                                const kinematics::GeometricErrors& errors,
                                const kinematics::Setup& setup,
                                const kinematics::CommandedProgram& nominal,
                                const kinematics::CommandedProgram& written,
                                std::span<const SourceSpan> sources,
                                const CompensationOptions& options) {
  const double bound = 0.5 * options.bound;
  trials::TrialOptions running = options.run;
  running.path_bound = bound;
  const auto travel = trials::tool_travel(machine, errors, setup, written, running);
  if (!travel) return travel.error();
  const ToolPath& path = travel->path;
  NominalSpans nominal_spans(machine, errors, setup, nominal, bound);
  if (path.blocks.size() != sources.size()) {
    return error("compensation-unproven"_id,
                 fmt::format("the program written has {} blocks with a tool, not {}",
                             path.blocks.size(), sources.size()),
                 "report this program");
  }
  const std::vector<ActualBlock> actual = actual_blocks(path);
  std::vector<std::vector<ToolPose>> wanted;
  std::vector<Turn> turns;
  std::vector<std::size_t> turns_before{0};  // each block
  for (std::size_t k = 0; k < sources.size(); ++k) {
    wanted.push_back(nominal_spans.poses(sources[k]));
    const std::vector<Turn> found = turns_of(sources[k], wanted[k], actual[k]);
    turns.insert(turns.end(), found.begin(), found.end());
    turns_before.push_back(turns.size());
  }
  CompensationProof proof;
  FeedRun run;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (path.blocks[k].kind != kinematics::PathKind::feed) {
      include(proof.at_turns, std::exchange(run, {}).at_turns());
      continue;
    }
    if (actual[k].poses.empty()) continue;
    run.add_wanted(wanted[k]);
    const std::size_t first = turns_before[k] - std::min(turns_before[k], kTurnsBeside);
    const std::size_t last = std::min(turns_before[k + 1] + kTurnsBeside, turns.size());
    for (const ToolPose& pose : actual[k].poses) {
      const Foot place = foot_on(pose, wanted[k]);
      const bool turning = std::any_of(turns.begin() + static_cast<std::ptrdiff_t>(first),
                                       turns.begin() + static_cast<std::ptrdiff_t>(last),
                                       [&](const Turn& turn) { return turn.is_near(place.pose); });
      run.pass(pose, place, turning);
      if (!turning) include(proof.beside, pose, place.pose);
    }
    if (sources[k].turn) continue;
    for (const ToolPose& pose : wanted[k]) {
      ToolPose passing = nearest(pose, actual[k].poses);
      const auto try_block = [&](std::size_t i) {
        if (distance(nearest(pose, wanted[i]), pose) > kTurnZone) return false;
        if (actual[i].poses.empty()) return true;
        const ToolPose other = nearest(pose, actual[i].poses);
        if (distance(other, pose) < distance(passing, pose)) passing = other;
        return true;
      };
      // Where an axis turns, it may be a block beside that passes.
      if (distance(passing, pose) > options.bound) {
        for (std::size_t i = k; i > 0 && try_block(i - 1);) --i;
        for (std::size_t i = k + 1; i < actual.size() && try_block(i);) ++i;
      }
      include(proof.beside, passing, pose);
    }
  }
  include(proof.at_turns, run.at_turns());
  return proof;
}

}  // namespace frustum::calibration

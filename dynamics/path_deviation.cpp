#include "dynamics/path_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/body_reader.hpp"

namespace frustum::dynamics {
namespace {

using kinematics::AxisPositions;
using kinematics::ToolPath;
using kinematics::ToolPose;

constexpr double kLongestRinging = 2.0;  // s
constexpr double kNothingLeft = 1e-8;    // m

// Poses first .. last of one tool, each joined to the next by a segment.
struct Chain {
  std::size_t first = 0, last = 0;
  std::uint32_t block = 0;  // of its last segment
  int tool = 0;
};

std::vector<Chain> chains_of(const ToolPath& path) {
  std::vector<Chain> chains;
  for (const kinematics::PathSegment& segment : path.segments) {
    const std::size_t from = segment.first_pose;
    if (chains.empty() || chains.back().last != from) {
      chains.push_back({from, from, segment.block, path.blocks[segment.block].tool});
    }
    chains.back().last = from + 1;
    chains.back().block = segment.block;
  }
  return chains;
}

// The commanded positions at the multiples first .. of the time step.
struct EvenMotion {
  double first = 0.0;
  std::vector<AxisPositions> positions{};
};

AxisPositions between(const AxisPositions& a, const AxisPositions& b, double share) {
  AxisPositions q;
  for (const auto letter : kinematics::kAxisLetters)
    q[letter] = std::lerp(a[letter], b[letter], share);
  return q;
}

// At rest for one step before the chain and one after it.
EvenMotion even_motion(const ToolPath& path, const Chain& chain, double step) {
  EvenMotion motion{.first = std::floor(path.times[chain.first] / step) - 1.0};
  const double last = std::ceil(path.times[chain.last] / step) + 1.0;
  std::size_t i = chain.first;
  for (double k = motion.first; k <= last; k += 1.0) {
    const double time = k * step;
    while (i < chain.last && path.times[i + 1] <= time) ++i;
    const double from = path.times[i];
    const double to = i < chain.last ? path.times[i + 1] : from;
    const double share = to > from ? std::clamp((time - from) / (to - from), 0.0, 1.0) : 0.0;
    const std::size_t after = std::min(i + 1, chain.last);
    motion.positions.push_back(between(path.axes[i].q, path.axes[after].q, share));
  }
  return motion;
}

double tool_length_of(const kinematics::Setup& setup, int tool) {
  const auto found = setup.tools.find(tool);
  return found == setup.tools.end() ? 0.0 : found->second.length + found->second.length_error;
}

class ChainDeviations {
 public:
  ChainDeviations(const DynamicModel& model, const ToolPath& path, const Chain& chain,
                  double tool_length, const PathDynamics& options)
      : step_(options.time_step) {
    EvenMotion motion = even_motion(path, chain, step_);
    first_ = motion.first;
    const bool rings = options.method == PathMethod::linear;
    if (rings) {
      const auto more = static_cast<std::size_t>(kLongestRinging / step_);
      motion.positions.insert(motion.positions.end(), more, motion.positions.back());
    }
    const auto samples = with_rates(motion.positions, step_);
    deviations_ = rings ? linear_deviations(model, samples, step_, tool_length, options.renewal)
                        : quasi_static_deviations(model, samples, tool_length);
    const auto left = std::find_if(deviations_.rbegin(), deviations_.rend(),
                                   [](const auto& d) { return d.tip.norm() >= kNothingLeft; });
    end_ = (first_ + static_cast<double>(deviations_.rend() - left)) * step_;
  }

  [[nodiscard]] TipDeviation at(double time) const {
    const double place =
        std::clamp(time / step_ - first_, 0.0, static_cast<double>(deviations_.size() - 1));
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, deviations_.size() - 1);
    const double share = place - static_cast<double>(below);
    const TipDeviation &a = deviations_[below], &b = deviations_[above];
    return {a.tip + share * (b.tip - a.tip), a.turn + share * (b.turn - a.turn)};
  }
  // When nothing is left of it.
  [[nodiscard]] double end() const { return end_; }

 private:
  double step_;
  double first_ = 0.0;
  double end_ = 0.0;
  std::vector<TipDeviation> deviations_{};
};

PoseDeviation in_workpiece(const TipDeviation& deviation, const Mat3& workpiece_from_table) {
  return {workpiece_from_table * deviation.tip / kMetresPerMm,
          workpiece_from_table * deviation.turn};
}

ToolPose moved(const ToolPose& pose, const PoseDeviation& deviation) {
  return {pose.tip + deviation.tip, (pose.axis + deviation.turn.cross(pose.axis)).normalized()};
}

}  // namespace

std::vector<PoseDeviation> pose_deviations(const DynamicModel& model,
                                           const kinematics::Setup& setup, const ToolPath& path,
                                           const PathDynamics& options) {
  std::vector<PoseDeviation> found(path.poses.size());
  if (options.method == PathMethod::off) return found;
  const Mat3 workpiece_from_table = setup.table_from_workpiece.rotation.transpose();
  for (const Chain& chain : chains_of(path)) {
    const ChainDeviations deviations(model, path, chain, tool_length_of(setup, chain.tool),
                                     options);
    for (std::size_t i = chain.first; i <= chain.last; ++i) {
      found[i] = in_workpiece(deviations.at(path.times[i]), workpiece_from_table);
    }
  }
  return found;
}

ToolPath with_dynamics(const DynamicModel& model, const kinematics::Setup& setup, ToolPath path,
                       const PathDynamics& options) {
  if (options.method == PathMethod::off) return path;
  const Mat3 workpiece_from_table = setup.table_from_workpiece.rotation.transpose();
  ToolPath result{.blocks = path.blocks, .bound = path.bound};
  std::size_t next_segment = 0;
  for (const Chain& chain : chains_of(path)) {
    const ChainDeviations deviations(model, path, chain, tool_length_of(setup, chain.tool),
                                     options);
    const auto add = [&](std::size_t pose, double time, const AxisPositions& velocity) {
      result.poses.push_back(
          moved(path.poses[pose], in_workpiece(deviations.at(time), workpiece_from_table)));
      result.axes.push_back(path.axes[pose]);
      result.times.push_back(time);
      result.velocities.push_back(velocity);
      result.shares.push_back(path.shares[pose]);
    };
    const auto go_on = [&](std::uint32_t block) {
      result.segments.push_back({static_cast<std::uint32_t>(result.poses.size() - 1), block});
    };
    add(chain.first, path.times[chain.first], path.velocities[chain.first]);
    for (std::size_t i = chain.first; i < chain.last; ++i) {
      go_on(path.segments[next_segment++].block);
      add(i + 1, path.times[i + 1], path.velocities[i + 1]);
    }
    const double arrived = path.times[chain.last];
    for (double k = std::floor(arrived / options.time_step) + 1.0;
         k * options.time_step <= deviations.end(); k += 1.0) {
      go_on(chain.block);
      add(chain.last, k * options.time_step, {});
    }
  }
  return result;
}

}  // namespace frustum::dynamics

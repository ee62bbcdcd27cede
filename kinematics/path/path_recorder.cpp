#include "kinematics/path/path_recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinematics/path/axis_polyline.hpp"
#include "kinematics/path/path_sampling.hpp"

namespace frustum::kinematics {
namespace {

// A sink gets its part of the path when it has grown to this many poses.
constexpr std::size_t kBatch = 16384;
// An axis limit that costs less than this share of a block's time is not worth telling.
constexpr double kNoticed = 0.01;

// Inverse solutions are dear, and sampling, cutting and checking ask for the same places.
class Remembered {
 public:
  explicit Remembered(const AxisMotion& motion) : motion_(motion) {}

  AxisPositions operator()(double u) {
    for (std::size_t i = 0; i < std::min(count_, seen_.size()); ++i) {
      if (seen_[i].first == u) return seen_[i].second;
    }
    auto& place = seen_[count_++ % seen_.size()];
    place = {u, motion_(u)};
    return place.second;
  }

 private:
  const AxisMotion& motion_;
  std::array<std::pair<double, AxisPositions>, 12> seen_{};
  std::size_t count_ = 0;
};

// The longest step between which axes at their acceleration stay within the bound of a straight line.
double lag_step(const Machine& machine, double bound) {
  double acceleration = 1000.0;  // mm/s^2: of machines that state none
  for (const Joint& joint : machine.joints()) {
    if (!joint.rotary()) acceleration = std::max(acceleration, joint.dynamics.acceleration);
  }
  return std::clamp(std::sqrt(4.0 * bound / acceleration), 1e-4, 1e-3);
}

AxisPositions times(const AxisPositions& q, double factor) {
  AxisPositions product;
  for (const AxisLetter letter : kAxisLetters) product[letter] = factor * q[letter];
  return product;
}

AxisPositions minus(const AxisPositions& a, const AxisPositions& b) {
  AxisPositions difference;
  for (const AxisLetter letter : kAxisLetters) difference[letter] = a[letter] - b[letter];
  return difference;
}

}  // namespace

PathRecorder::PathRecorder(const Machine& machine, const GeometricErrors& errors,
                           const Pose& workpiece_from_table, const AxisPositions& start,
                           RecorderOptions options)
    : machine_(machine),
      errors_(errors),
      workpiece_from_table_(workpiece_from_table),
      options_(std::move(options)),
      tracker_(errors),
      law_(machine, options_.time_law),
      lag_(machine, start),
      lag_step_(lag_step(machine, options_.path_bound)) {
  path_.bound = options_.path_bound;
}

void PathRecorder::travel(BlockOrder order) {
  Pending pending{.order = std::move(order)};
  const AxisMotion& exact = pending.order.motion.at;
  Remembered remembered(exact);
  const AxisMotion motion = [&remembered](double u) { return remembered(u); };
  const int parts = pending.order.motion.least_parts();
  if (pending.order.has_tool) {
    pending.starts_chain = chain_broken_;
    chain_broken_ = false;
  }
  if (!options_.servo_lag) sample(pending, motion, parts);
  give_to_time_law(pending, motion, parts);
  pending_.push_back(std::move(pending));
  collect_times();
}

void PathRecorder::break_chain() { chain_broken_ = true; }

ToolPose PathRecorder::pose_at(const AxisState& axes, double tool_length) {
  if (!chain_ || tool_length != chain_length_) {
    chain_.emplace(machine_, errors_, tool_length);
    chain_length_ = tool_length;
  }
  return tool_pose(workpiece_from_table_ * chain_->table_from_tool(axes));
}

void PathRecorder::sample(Pending& pending, const AxisMotion& motion, int parts) {
  const BlockOrder& order = pending.order;
  const ApproachProfile approach_directions = tracker_.follow(motion, parts);
  if (!order.has_tool) return;
  const auto arriving = [&](double u) {
    const AxisPositions q = motion(u);
    return AxisState(q, approach_directions.at(u, q));
  };
  const auto add = [&](double u, const AxisState& axes, const ToolPose& pose) {
    pending.samples.push_back({u, pose, axes});
    last_pose_ = pose;
  };
  const auto add_leaving = [&](double u) {
    const AxisState axes(motion(u), approach_directions.after(u));
    add(u, axes, pose_at(axes, order.tool_length));
  };
  const auto turns = approach_directions.turning_points();
  const auto turns_at = [&](double u) {
    return std::find(turns.begin(), turns.end(), u) != turns.end();
  };
  std::vector<double> ends(turns.begin(), turns.end());
  ends.insert(ends.end(), order.motion.breaks.begin(), order.motion.breaks.end());
  ends.push_back(1.0);
  std::sort(ends.begin(), ends.end());

  if (pending.starts_chain || turns_at(0.0)) add_leaving(0.0);
  double u0 = 0.0;
  for (const double u1 : ends) {
    if (u1 <= u0) continue;
    const double width = u1 - u0;
    const auto actual = [&](double w) {
      return pose_at(arriving(w == 1.0 ? u1 : u0 + w * width), order.tool_length);
    };
    const int least = std::max(1, static_cast<int>(std::ceil(parts * width)));
    for (const PathSample& s :
         sample_motion(actual, last_pose_, {options_.path_bound, order.reach, least})) {
      const double u = s.u == 1.0 ? u1 : u0 + s.u * width;
      add(u, arriving(u), s.pose);
    }
    // An error that jumps here moves the tool at once.
    if (u1 < 1.0 && turns_at(u1)) add_leaving(u1);
    u0 = u1;
  }
}

void PathRecorder::give_to_time_law(Pending& pending, const AxisMotion& motion, int parts) {
  const BlockMotion& block = pending.order.motion;
  const double feed_time = pending.order.block.feed_duration;
  if (block.straight || (feed_time > 0.0 && !law_.limits_any() && !options_.servo_lag)) {
    if (law_.add(minus(block.end, block.start), {}, feed_time, true)) pending.ends.push_back(1.0);
    return;
  }
  double u0 = 0.0;
  AxisPositions from = block.start;
  for (const EvenPart& part : even_parts(motion, parts, block.breaks)) {
    // What does not move the axes adds its share of the feed's time to what does.
    if (law_.add(minus(part.to, from), part.unevenness, feed_time * (part.end - u0),
                 pending.ends.empty())) {
      pending.ends.push_back(part.end);
      from = part.to;
      u0 = part.end;
    }
  }
}

void PathRecorder::collect_times() {
  const auto is_complete = [](const Pending& p) { return p.segments.size() == p.ends.size(); };
  const auto deliver_complete = [&] {
    while (!pending_.empty() && is_complete(pending_.front())) {
      deliver(pending_.front());
      pending_.pop_front();
    }
  };
  deliver_complete();
  while (auto segment = law_.next()) {
    pending_.front().segments.push_back(*std::move(segment));
    deliver_complete();
  }
}

void PathRecorder::deliver(Pending& pending) {
  PathBlock& block = pending.order.block;
  const auto& segments = pending.segments;
  const double start = segments.empty() ? clock_ : segments.front().start;
  if (!segments.empty()) clock_ = segments.back().start + segments.back().duration;
  block.duration = clock_ - start;
  std::array<double, kAxisLetters.size()> lost{};
  for (const TimedSegment& s : segments) {
    if (s.limited_by) lost[static_cast<std::size_t>(*s.limited_by)] += s.lost;
  }
  const auto worst = std::max_element(lost.begin(), lost.end());
  if (block.feed_duration > 0.0 && *worst > 0.0 &&
      block.duration > (1.0 + kNoticed) * block.feed_duration) {
    block.limited_by = kAxisLetters.at(static_cast<std::size_t>(worst - lost.begin()));
  }
  const std::vector<TimedPose> poses =
      options_.servo_lag ? lagged_samples(pending) : timed_samples(pending);
  if (!pending.order.has_tool) return;
  path_.blocks.push_back(block);
  append(poses, !pending.starts_chain);
  hand_over();
}

std::vector<PathRecorder::TimedPose> PathRecorder::timed_samples(const Pending& pending) const {
  std::vector<TimedPose> poses;
  poses.reserve(pending.samples.size());
  std::size_t k = 0;
  for (const Sample& s : pending.samples) {
    while (k + 1 < pending.ends.size() && pending.ends[k] < s.u) ++k;
    TimedPose pose{s.pose, s.axes, clock_, {}};
    if (k < pending.segments.size()) {
      const TimedSegment& segment = pending.segments[k];
      const double begin = k > 0 ? pending.ends[k - 1] : 0.0;
      pose.time = segment.time_at((s.u - begin) / (pending.ends[k] - begin));
      pose.velocity = times(segment.per_length, segment.speed_at(pose.time));
    }
    poses.push_back(pose);
  }
  return poses;
}

PathRecorder::TimedPose PathRecorder::lagged(const AxisPositions& commanded, double seconds,
                                             double time, double tool_length) {
  const AxisPositions from = lag_.actual();
  const AxisPositions to = lag_.follow(commanded, seconds);
  AxisState axes(to);
  if (tracker_.follows_any()) {
    // The guides see the axes, not their commands.
    axes.heading =
        tracker_.follow([from, to](double u) { return part_way(from, to, u); }, 1).at(1.0);
  }
  const AxisPositions velocity =
      seconds > 0.0 ? times(minus(to, from), 1.0 / seconds) : AxisPositions{};
  return {pose_at(axes, tool_length), axes, time, velocity};
}

std::vector<PathRecorder::TimedPose> PathRecorder::lagged_samples(const Pending& pending) {
  const BlockOrder& order = pending.order;
  std::vector<TimedPose> poses;
  if (pending.starts_chain) {
    poses.push_back(
        lagged(order.motion.start, 0.0, clock_ - order.block.duration, order.tool_length));
  }
  double begin = 0.0;
  for (std::size_t k = 0; k < pending.segments.size(); ++k) {
    const TimedSegment& segment = pending.segments[k];
    const int steps = 1 + static_cast<int>(segment.duration / lag_step_);
    for (int i = 1; i <= steps; ++i) {
      const double time = segment.start + segment.duration * i / steps;
      const double share = i == steps ? 1.0 : segment.share_at(time);
      const double u = begin + share * (pending.ends[k] - begin);
      poses.push_back(
          lagged(order.motion.at(u), segment.duration / steps, time, order.tool_length));
    }
    begin = pending.ends[k];
  }
  lag_tool_ = order.tool_length;
  lag_has_path_ = order.has_tool;
  return poses;
}

// In position: what is left of the lag is run out before the axes count as standing.
void PathRecorder::settle(double seconds) {
  const AxisPositions commanded = lag_.commanded();
  const int steps = 1 + static_cast<int>(seconds / lag_step_);
  std::vector<TimedPose> poses;
  for (int i = 1; i <= steps; ++i) {
    poses.push_back(lagged(commanded, seconds / steps, clock_ + seconds * i / steps, lag_tool_));
  }
  lag_.settle();
  poses.push_back(lagged(commanded, 0.0, clock_ + seconds, lag_tool_));
  if (lag_has_path_ && !path_.blocks.empty()) append(poses, true);
}

void PathRecorder::append(const std::vector<TimedPose>& poses, bool continues) {
  auto first = static_cast<std::uint32_t>(path_.poses.size());
  if (continues && first > 0) --first;
  for (const TimedPose& p : poses) {
    path_.poses.push_back(p.pose);
    path_.axes.push_back(p.axes);
    path_.times.push_back(p.time);
    path_.velocities.push_back(p.velocity);
  }
  const auto block = static_cast<std::uint32_t>(path_.blocks.size() - 1);
  for (auto i = first; i + 1 < path_.poses.size(); ++i) path_.segments.push_back({i, block});
}

void PathRecorder::rest(double seconds) {
  const bool has_moved = !pending_.empty();
  const double lost_motion = options_.servo_lag && has_moved ? lag_.settling_time() : 0.0;
  const double wait = std::max(seconds, lost_motion);
  law_.rest(wait);
  collect_times();
  if (lost_motion > 0.0) settle(wait);
  clock_ = law_.now();
}

void PathRecorder::hand_over() {
  if (!options_.sink || path_.poses.size() < kBatch) return;
  options_.sink(path_);
  ToolPath next;
  next.bound = path_.bound;
  next.poses = {path_.poses.back()};
  next.axes = {path_.axes.back()};
  next.times = {path_.times.back()};
  next.velocities = {path_.velocities.back()};
  path_ = std::move(next);
}

ToolPath PathRecorder::finish() {
  rest(0.0);
  if (!options_.sink) return std::move(path_);
  if (!path_.segments.empty()) options_.sink(path_);
  ToolPath nothing;
  nothing.bound = path_.bound;
  return nothing;
}

}  // namespace frustum::kinematics

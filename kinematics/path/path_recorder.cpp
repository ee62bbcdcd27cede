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
// An axis limit that costs less than this share of a block's time is not worth reporting.
constexpr double kNoticed = 0.01;

// The longest step between which axes at their acceleration stay within the bound of a straight
// line.
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

PathRecorder::PathRecorder(const Machine& machine, const Setup& setup,
                           const GeometricErrors& errors, const AxisPositions& start,
                           TravelOptions options)
    : machine_(machine),
      setup_(setup),
      errors_(errors),
      workpiece_from_table_(setup.table_from_workpiece.inverse()),
      options_(std::move(options)),
      tracker_(errors),
      law_(machine, options_.time_law),
      lag_(machine, start),
      lag_step_(lag_step(machine, options_.path_bound)) {
  if (options_.time_step > 0.0) lag_step_ = std::min(lag_step_, options_.time_step);
  path_.bound = options_.path_bound;
}

void PathRecorder::follow(const CommandedStep& step) {
  if (const auto* move = std::get_if<CommandedMove>(&step)) {
    travel(*move);
  } else if (const auto* wait = std::get_if<CommandedRest>(&step)) {
    rest(wait->seconds);
  } else {
    rest(0.0);
    chain_broken_ = true;  // another tool
  }
}

void PathRecorder::travel(const CommandedMove& move) {
  Pending pending{.move = move};
  const int parts = move.motion.least_parts();
  if (pending.has_tool()) {
    const ToolGeometry& tool = setup_.tools.at(move.tool);
    pending.tool_length = tool.length + tool.length_error;
    pending.reach = tool.flute_length;
    pending.starts_chain = chain_broken_;
    chain_broken_ = false;
  }
  if (!options_.servo_lag) sample(pending, parts);
  give_to_time_law(pending, parts);
  pending_.push_back(std::move(pending));
  collect_times();
}

ToolPose PathRecorder::pose_at(const AxisState& axes, double tool_length) {
  if (!chain_ || tool_length != chain_length_) {
    chain_.emplace(machine_, errors_, tool_length);
    chain_length_ = tool_length;
  }
  return tool_pose(workpiece_from_table_ * chain_->table_from_tool(axes));
}

void PathRecorder::sample(Pending& pending, int parts) {
  const BlockMotion& motion = pending.move.motion;
  const ApproachProfile approach =
      tracker_.follow([&motion](double u) { return motion.at(u); }, parts);
  if (!pending.has_tool()) return;
  if (options_.time_step > 0.0) pending.approach = approach;
  const auto add = [&](double u, const AxisState& axes, const ToolPose& pose) {
    pending.samples.push_back({u, pose, axes});
    last_pose_ = pose;
  };
  const auto add_leaving = [&](double u) {
    const AxisState axes(motion.at(u), approach.after(u));
    add(u, axes, pose_at(axes, pending.tool_length));
  };
  const auto turns = approach.turning_points();
  const auto turns_at = [&](double u) {
    return std::find(turns.begin(), turns.end(), u) != turns.end();
  };
  const auto breaks = motion.breaks();
  std::vector<double> ends(turns.begin(), turns.end());
  ends.insert(ends.end(), breaks.begin(), breaks.end());
  ends.push_back(1.0);
  std::sort(ends.begin(), ends.end());

  if (pending.starts_chain || turns_at(0.0)) add_leaving(0.0);
  double u0 = 0.0;
  for (const double u1 : ends) {
    if (u1 <= u0) continue;
    const double width = u1 - u0;
    const auto arriving = [&](double w) {
      const double u = w == 1.0 ? u1 : u0 + w * width;
      const AxisPositions q = motion.at(u);
      const AxisState axes(q, approach.at(u, q));
      return Sample{u, pose_at(axes, pending.tool_length), axes};
    };
    const int least = std::max(1, static_cast<int>(std::ceil(parts * width)));
    const SamplingOptions sampling{options_.path_bound, pending.reach, least};
    PathSampler(arriving, sampling).sample(last_pose_, [&](double /*w*/, const Sample& s) {
      add(s.u, s.axes, s.pose);
    });
    // An error that jumps here moves the tool at once.
    if (u1 < 1.0 && turns_at(u1)) add_leaving(u1);
    u0 = u1;
  }
}

void PathRecorder::give_to_time_law(Pending& pending, int parts) {
  const BlockMotion& motion = pending.move.motion;
  const double feed_time = pending.move.feed_duration;
  if (motion.straight() || (feed_time > 0.0 && !law_.limits_any() && !options_.servo_lag)) {
    if (law_.add(minus(motion.end(), motion.start()), {}, feed_time, true))
      pending.ends.push_back(1.0);
    // A circle that ends where it begins takes its time, too: that of its parts.
    if (motion.straight() || !pending.ends.empty()) return;
  }
  double u0 = 0.0;
  AxisPositions from = motion.start();
  for (const EvenPart& part :
       even_parts([&motion](double u) { return motion.at(u); }, parts, motion.breaks())) {
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
  const CommandedMove& move = pending.move;
  PathBlock block{.source_line = move.source_line,
                  .source_file = move.source_file,
                  .main_line = move.main_line,
                  .kind = move.kind,
                  .spindle = move.spindle,
                  .tool = move.tool,
                  .feed = move.feed,
                  .feed_duration = move.feed_duration};
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
  std::vector<TimedPose> poses =
      options_.servo_lag ? lagged_samples(pending, block.duration) : timed_samples(pending);
  has_path_ = pending.has_tool();
  if (!has_path_) return;
  if (pending.approach) add_even_times(pending, poses);
  // Not before: the axes may yet settle at the end of the last block.
  hand_over();
  path_.blocks.push_back(block);
  append(poses, !pending.starts_chain);
}

std::vector<PathRecorder::TimedPose> PathRecorder::timed_samples(const Pending& pending) const {
  std::vector<TimedPose> poses;
  poses.reserve(pending.samples.size());
  std::size_t k = 0;
  for (const Sample& s : pending.samples) {
    while (k + 1 < pending.ends.size() && pending.ends[k] < s.u) ++k;
    TimedPose pose{s.pose, s.axes, clock_, {}, s.u};
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

// Poses at the multiples of the time step, in among the others.
void PathRecorder::add_even_times(const Pending& pending, std::vector<TimedPose>& poses) {
  const BlockMotion& motion = pending.move.motion;
  const double step = options_.time_step;
  double begin = 0.0;
  for (std::size_t k = 0; k < pending.segments.size(); ++k) {
    const TimedSegment& segment = pending.segments[k];
    const double end = segment.start + segment.duration;
    for (double i = std::floor(segment.start / step) + 1.0; i * step < end; i += 1.0) {
      const double share = segment.share_at(i * step);
      const double u = begin + share * (pending.ends[k] - begin);
      const AxisPositions q = motion.at(u);
      const AxisState axes(q, pending.approach->at(u, q));
      poses.push_back({pose_at(axes, pending.tool_length), axes, i * step,
                       times(segment.per_length, segment.speed_at(i * step)), u});
    }
    begin = pending.ends[k];
  }
  std::stable_sort(poses.begin(), poses.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.time < b.time; });
}

// Poses at the multiples of the time step while the axes wait with a tool.
void PathRecorder::stand(double seconds) {
  if (!has_path_ || path_.poses.empty() || path_.blocks.empty()) return;
  const double step = options_.time_step;
  std::vector<TimedPose> poses;
  const auto add = [&](double time) {
    poses.push_back({path_.poses.back(), path_.axes.back(), time, {}});
  };
  for (double i = std::floor(clock_ / step) + 1.0; i * step < clock_ + seconds; i += 1.0) {
    add(i * step);
  }
  add(clock_ + seconds);
  append(poses, true);
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

std::vector<PathRecorder::TimedPose> PathRecorder::lagged_samples(const Pending& pending,
                                                                  double duration) {
  const BlockMotion& motion = pending.move.motion;
  std::vector<TimedPose> poses;
  if (pending.starts_chain) {
    poses.push_back(lagged(motion.start(), 0.0, clock_ - duration, pending.tool_length));
    poses.back().share = 0.0;
  }
  double begin = 0.0;
  for (std::size_t k = 0; k < pending.segments.size(); ++k) {
    const TimedSegment& segment = pending.segments[k];
    const int steps = 1 + static_cast<int>(segment.duration / lag_step_);
    for (int i = 1; i <= steps; ++i) {
      const double time = segment.start + segment.duration * i / steps;
      const double share = i == steps ? 1.0 : segment.share_at(time);
      const double u = begin + share * (pending.ends[k] - begin);
      poses.push_back(lagged(motion.at(u), segment.duration / steps, time, pending.tool_length));
      poses.back().share = u;
    }
    begin = pending.ends[k];
  }
  lag_tool_ = pending.tool_length;
  lag_has_path_ = pending.has_tool();
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
    path_.times.push_back(p.time);
    if (options_.poses_alone) continue;
    path_.axes.push_back(p.axes);
    path_.velocities.push_back(p.velocity);
    path_.shares.push_back(p.share);
  }
  const auto block = static_cast<std::uint32_t>(path_.blocks.size() - 1);
  for (auto i = first; i + 1 < path_.poses.size(); ++i) path_.segments.push_back({i, block});
}

void PathRecorder::rest(double seconds) {
  law_.rest(0.0);
  collect_times();
  const double in_position = lag_.settling_time();
  const double wait = std::max(seconds, in_position);
  law_.rest(wait);
  if (in_position > 0.0) settle(wait);
  if (options_.time_step > 0.0 && !options_.servo_lag && wait > 0.0) stand(wait);
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
  next.shares = {path_.shares.back()};
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

#include "dynamics/jerk_move.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dynamics/time_step.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRowStep = 0.01;       // s
constexpr double kAfterMove = 0.2;      // s
constexpr double kLeastTime = 0.6;      // s
constexpr double kLargestStep = 0.005;  // s
constexpr double kLookStep = 5e-4;      // s: between the looks for the peak

// The speed that a move of this length reaches.
double top_speed(const MoveLimits& m) {
  const double distance = std::abs(m.distance);
  const double ramp_speed = m.acceleration * m.acceleration / m.jerk;  // jerk alone reaches it
  const double by_jerk = std::cbrt(distance * distance * m.jerk / 4.0);
  if (by_jerk <= ramp_speed) return std::min(m.velocity, by_jerk);
  const double ramp = m.acceleration / m.jerk;
  return std::min(
      m.velocity,
      0.5 * m.acceleration * (std::sqrt(ramp * ramp + 4.0 * distance / m.acceleration) - ramp));
}

double acceleration_at(const std::vector<Breakpoint>& profile, double time) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Breakpoint &a = profile[i - 1], &b = profile[i];
    if (time > b.time) continue;
    return std::lerp(a.acceleration, b.acceleration,
                     std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0));
  }
  return 0.0;
}

bool is_multiple(double time, double step) {
  return std::abs(time / step - std::round(time / step)) < 1e-9;
}

// Looks, rows and ends of phases, each once.
std::vector<double> times_of(const std::vector<Breakpoint>& profile, double end) {
  std::vector<double> times;
  for (int i = 0; i * kLookStep <= end * (1.0 + 1e-12); ++i) times.push_back(i * kLookStep);
  for (const Breakpoint& b : profile) times.push_back(b.time);
  std::ranges::sort(times);
  constexpr double kSame = 1e-12;  // s
  const auto last =
      std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < kSame; });
  times.erase(last, times.end());
  return times;
}

}  // namespace

std::vector<Breakpoint> jerk_profile(const MoveLimits& limits) {
  const double speed = top_speed(limits);
  const double peak = std::min(limits.acceleration, std::sqrt(speed * limits.jerk));
  const double ramp = peak / limits.jerk;
  const double held = std::max(0.0, speed / peak - ramp);
  const double faster = 2.0 * ramp + held;
  const double even = std::max(0.0, std::abs(limits.distance) / speed - faster);
  const double sign = limits.distance < 0.0 ? -1.0 : 1.0;
  std::vector<Breakpoint> profile{{0.0, 0.0}};
  const auto go = [&](double seconds, double acceleration) {
    if (seconds > 0.0) profile.push_back({profile.back().time + seconds, sign * acceleration});
  };
  for (const double direction : {1.0, -1.0}) {
    go(ramp, direction * peak);
    go(held, direction * peak);
    go(ramp, 0.0);
    if (direction > 0.0) go(even, 0.0);
  }
  return profile;
}

JerkMove jerk_move(const DynamicModel& model, const kinematics::AxisPositions& q,
                   double tool_length, std::size_t axis, const MoveLimits& limits) {
  JerkMove move{.breakpoints = jerk_profile(limits)};
  const double arrives = move.breakpoints.back().time;
  const double end = std::max(kLeastTime, std::ceil((arrives + kAfterMove) / kRowStep) * kRowStep);
  const ServoSystem system = servo_system(model, q, tool_length, Drives::springs);
  const StateSpace space = state_space(system);
  const VectorXd unit_input =
      space.from_loads * system.unit_acceleration_loads.col(static_cast<Index>(axis));
  const Eigen::MatrixXd tip = system.tip.topRows(3) * space.positions;
  const std::vector<double> times = times_of(move.breakpoints, end);
  std::map<long long, TimeStep> steps;  // by their length in picoseconds
  VectorXd state = VectorXd::Zero(space.matrix.rows());
  double before = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double now = acceleration_at(move.breakpoints, times[i]);
    if (i > 0) {
      const double seconds = times[i] - times[i - 1];
      const auto key = std::llround(seconds * 1e12);
      const auto step = steps.try_emplace(key, space.matrix, seconds).first;
      state = step->second(state, before * unit_input, now * unit_input);
    }
    before = now;
    const Vec3 d = tip * state;
    move.peak = move.peak.cwiseMax(d.cwiseAbs());
    if (is_multiple(times[i], kRowStep)) move.rows.push_back({times[i], d});
    if (!is_multiple(times[i], kLargestStep)) continue;
    move.largest = move.largest.cwiseMax(d.cwiseAbs());
    if (times[i] >= arrives - 1e-12) move.largest_after = move.largest_after.cwiseMax(d.cwiseAbs());
  }
  return move;
}

}  // namespace frustum::dynamics

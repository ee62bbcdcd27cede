#include "kinematics/timing/speed_phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::kinematics {

double SpeedPhase::time_of(double way) const {
  if (way <= 0.0) return 0.0;
  if (jerk == 0.0) {
    // v t + a t^2 / 2 = way, in the form that neither cancels nor divides by a = 0.
    const double root = std::sqrt(std::max(speed * speed + 2.0 * acceleration * way, 0.0));
    const double t = 2.0 * way / (speed + root);
    return std::isfinite(t) ? std::min(t, duration) : duration;
  }
  double low = 0.0, high = duration;
  double t = 0.5 * duration;
  // Newton within a bracket that halves at worst: 100 halvings exhaust a double.
  for (int step = 0; step < 100 && high - low > 1e-15 * duration; ++step) {
    const double off = length_after(t) - way;
    (off > 0.0 ? high : low) = t;
    const double v = speed_after(t);
    const double newton = v > 0.0 ? t - off / v : -1.0;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == t) break;
    t = next;
  }
  return t;
}

SpeedPhase SpeedPhase::after(double t) const {
  return {duration - t, std::max(speed_after(t), 0.0), acceleration + t * jerk, jerk};
}

std::vector<SpeedPhase> trapezoid(double length, double from, double to, double top,
                                  double acceleration) {
  if (!std::isfinite(acceleration)) return {{length / top, top, 0.0, 0.0}};
  const double squared = acceleration * length + 0.5 * (from * from + to * to);
  const double peak = std::max({std::min(std::sqrt(squared), top), from, to});
  const double rising = std::min((peak * peak - from * from) / (2.0 * acceleration), length);
  const double falling = std::min((peak * peak - to * to) / (2.0 * acceleration), length - rising);
  const double level = length - rising - falling;
  std::vector<SpeedPhase> phases;
  if (rising > 0.0) phases.push_back({2.0 * rising / (from + peak), from, acceleration, 0.0});
  if (level > 0.0) phases.push_back({level / peak, peak, 0.0, 0.0});
  if (falling > 0.0) phases.push_back({2.0 * falling / (peak + to), peak, -acceleration, 0.0});
  return phases;
}

void SpeedAverage::add(const SpeedPhase& phase) {
  if (phase.duration <= 0.0) return;
  if (at_rest_) {
    behind_.assign(1, {window_, 0.0, 0.0, 0.0});
    covered_ = 0.0;
    at_rest_ = false;
  }
  ahead_.push_back(phase);
}

void SpeedAverage::rest() {
  if (at_rest_) return;
  ahead_.push_back({window_, 0.0, 0.0, 0.0});
  at_rest_ = true;
}

std::optional<SpeedPhase> SpeedAverage::next() {
  if (ahead_.empty()) return std::nullopt;
  const SpeedPhase leading = ahead_.front();
  const SpeedPhase trailing = behind_.front();
  const double step = std::min(leading.duration, trailing.duration);
  const SpeedPhase mean{step, std::max(covered_, 0.0) / window_,
                        (leading.speed - trailing.speed) / window_,
                        (leading.acceleration - trailing.acceleration) / window_};
  covered_ += leading.length_after(step) - trailing.length_after(step);
  behind_.push_back(leading);
  behind_.back().duration = step;
  pass(ahead_, step);
  pass(behind_, step);
  return mean;
}

void SpeedAverage::pass(std::deque<SpeedPhase>& phases, double time) {
  if (time < phases.front().duration) {
    phases.front() = phases.front().after(time);
  } else {
    phases.pop_front();
  }
}

}  // namespace frustum::kinematics

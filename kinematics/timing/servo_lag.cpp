#include "kinematics/timing/servo_lag.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::kinematics {

ServoLag::ServoLag(const Machine& machine, const AxisPositions& start)
    : commanded_(start), actual_(start) {
  for (const Joint& joint : machine.joints()) {
    gain_[static_cast<std::size_t>(joint.letter)] = joint.dynamics.servo_gain;
  }
}

const AxisPositions& ServoLag::follow(const AxisPositions& commanded, double seconds) {
  for (const AxisLetter letter : kAxisLetters) {
    const double gain = gain_[static_cast<std::size_t>(letter)];
    double lag = 0.0;
    if (gain > 0.0) {
      lag = commanded_[letter] - actual_[letter];
      if (seconds > 0.0) {
        const double steady = (commanded[letter] - commanded_[letter]) / seconds / gain;
        lag = steady + (lag - steady) * std::exp(-gain * seconds);
      } else {
        lag += commanded[letter] - commanded_[letter];
      }
    }
    actual_[letter] = commanded[letter] - lag;
  }
  commanded_ = commanded;
  return actual_;
}

double ServoLag::settling_time() const {
  if (actual_ == commanded_) return 0.0;
  double time = 0.0;
  for (const double gain : gain_) {
    if (gain > 0.0) time = std::max(time, 12.0 / gain);
  }
  return time;
}

}  // namespace frustum::kinematics

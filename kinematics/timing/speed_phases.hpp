// Speed along a path over time, in phases of constant jerk, and its average over a window of time.
//
// Model    : v(t) = v0 + a t + j t^2 / 2 within a phase. The average over T of a profile of
//            constant accelerations has jerk (a(t + T/2) - a(t - T/2)) / T and begins and ends at
//            rest
// Units    : s; lengths in whatever unit the path has
// Errors   : none
// Accuracy : exact phase by phase (tests/kinematics/time_law_test.cpp)
#pragma once

#include <deque>
#include <optional>
#include <vector>

namespace frustum::kinematics {

struct SpeedPhase {
  double duration = 0.0;
  double speed = 0.0;         // at its beginning
  double acceleration = 0.0;  // at its beginning
  double jerk = 0.0;

  [[nodiscard]] double length_after(double t) const {
    return t * (speed + t * (0.5 * acceleration + t * (jerk / 6.0)));
  }
  [[nodiscard]] double speed_after(double t) const {
    return speed + t * (acceleration + 0.5 * t * jerk);
  }
  [[nodiscard]] double length() const { return length_after(duration); }
  // When `way` is covered; at most `duration`.
  [[nodiscard]] double time_of(double way) const;
  // What is left of the phase after a time.
  [[nodiscard]] SpeedPhase after(double t) const;
};

// At most three phases of constant acceleration over `length`, from one speed to another, never
// above `top`; an infinite acceleration runs at `top` all the way.
[[nodiscard]] std::vector<SpeedPhase> trapezoid(double length, double from, double to, double top,
                                                double acceleration);

// Phases of constant acceleration in, their average over `window` seconds out; streamed.
class SpeedAverage {
 public:
  explicit SpeedAverage(double window) : window_(window) {}
  void add(const SpeedPhase& phase);
  // The axes stand still until all of the window has passed.
  void rest();
  // The next phase that is known.
  [[nodiscard]] std::optional<SpeedPhase> next();

 private:
  static void pass(std::deque<SpeedPhase>& phases, double time);

  double window_;
  std::deque<SpeedPhase> ahead_{};   // not yet reached by the leading end of the window
  std::deque<SpeedPhase> behind_{};  // not yet left by its trailing end
  double covered_ = 0.0;             // length of what the window sees
  bool at_rest_ = true;              // all that comes after begins from standstill
};

}  // namespace frustum::kinematics

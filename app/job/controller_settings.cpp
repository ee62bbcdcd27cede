#include "app/job/controller_settings.hpp"

#include <fmt/format.h>

namespace frustum::app {

namespace {

dynamics::PathDynamics read_dynamics(const TomlTable& table) {
  dynamics::PathDynamics settings;
  settings.method = static_cast<dynamics::PathMethod>(
      table.choice_or("dynamics", {"off", "quasi_static", "linear"}, 0));
  // Blocks of a millisecond and less, whose ends are rounded, bend the path by steps that are no
  // motion; two milliseconds leave them out and keep what a quasi-static machine follows.
  if (settings.method == dynamics::PathMethod::quasi_static) settings.time_step = 2e-3;
  settings.time_step = table.number_or("dynamics_step", settings.time_step, Bound::positive);
  settings.renewal.linear =
      table.number_or("dynamics_renewal", settings.renewal.linear, Bound::positive);
  settings.renewal.rotary =
      kRadPerDeg * table.number_or("dynamics_rotary_renewal", settings.renewal.rotary * kDegPerRad,
                                   Bound::positive);
  // A path of less is no longer computed in time; one of more loses vibrations of 100 Hz.
  constexpr double kShortest = 1e-5, kLongest = 5e-3;
  if (settings.time_step < kShortest || settings.time_step > kLongest) {
    table.fail(
        "dynamics_step", "out-of-range"_id,
        fmt::format("{:g} s: expected {:g} to {:g} s", settings.time_step, kShortest, kLongest),
        "0.0005 is half a millisecond");
    settings.time_step = kLongest;
  }
  return settings;
}

}  // namespace

ControllerSettings read_controller(const TomlTable& job) {
  ControllerSettings settings;
  const auto table = job.table_if("controller");
  if (!table) return settings;
  kinematics::TimeLawOptions& law = settings.time_law;
  law.limits = table->boolean_or("time_law", law.limits);
  law.jerk = table->boolean_or("jerk", law.jerk);
  law.corner_time = table->number_or("corner_time", law.corner_time, Bound::positive);
  law.jerk_time = table->number_or("jerk_time", law.jerk_time, Bound::positive);
  law.rapid = table->number_or("default_rapid", law.rapid, Bound::positive);
  law.rotary_rapid = kRadPerDeg * table->number_or("default_rotary_rapid",
                                                   law.rotary_rapid * kDegPerRad, Bound::positive);
  settings.servo_lag = table->boolean_or("servo_lag", settings.servo_lag);
  settings.dynamics = read_dynamics(*table);
  if (law.jerk && !law.limits) {
    table->fail("jerk", "jerk limits need the time law", "remove time_law = false");
  }
  return settings;
}

}  // namespace frustum::app

#include "app/job/controller_settings.hpp"

namespace frustum::app {

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
  if (law.jerk && !law.limits) {
    table->fail("jerk", "jerk limits need the time law", "remove time_law = false");
  }
  return settings;
}

}  // namespace frustum::app

#include "instruments/touch_program.hpp"

namespace frustum::instruments {

ProbingProgram touch_program(const TouchPlan& plan, const TouchProbe& probe) {
  constexpr double kAbove = 10.0;  // mm, between the ball and the highest that a column turns to
  ProbingProgram program{
      .title = "TOUCH-TRIGGER CALIBRATION OF A AND C",
      .origin = "ORIGIN WHERE THE AXES A AND C CROSS. TOOL LENGTH: TO THE CENTRE OF THE BALL",
      .name = "touch",
      .number = 5007,
      .rotary = "AC",
      .safe = column_reach() + probe.ball_radius + kAbove,
      .turning = column_reach() + probe.ball_radius + kAbove,
      .back = kTouchApproach};
  for (const PlannedTouch& planned : plan.touches) {
    const TouchPoint& point = touch_points().at(planned.point);
    const Mat3 rotation = plan.rotation(planned);
    const Vec3 normal = rotation * point.normal;
    const Vec3 contact = rotation * point.place + probe.ball_radius * normal;
    program.touches.push_back(
        {.turned = {plan.tilts[planned.tilt].axis, plan.turns[planned.turn].axis},
         .point = planned.point,
         .approach = contact + kTouchApproach * normal,
         .end = contact - kTouchApproach * normal});
  }
  return program;
}

}  // namespace frustum::instruments

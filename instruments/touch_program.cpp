#include "instruments/touch_program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/decimal.hpp"

namespace frustum::instruments {
namespace {

constexpr double kFeed = 100.0;  // mm/min, as touches are slow
constexpr double kAbove = 10.0;  // mm, between the ball and the highest that a column turns to

// Words of a place, to a nanometre.
std::string words_of(const Vec3& p) {
  return fmt::format("X{} Y{} Z{}", fixed_decimal(p.x(), 6), fixed_decimal(p.y(), 6),
                     fixed_decimal(p.z(), 6));
}

std::string degrees(const TablePosition& position) {
  return shortest_decimal(as_stated(position.axis * kDegPerRad));
}

}  // namespace

std::string touch_program(const TouchPlan& plan, const TouchProbe& probe) {
  const std::string safe = fixed_decimal(column_reach() + probe.ball_radius + kAbove, 3);
  std::string text =
      "(TOUCH-TRIGGER CALIBRATION OF A AND C)\n"
      "(G54: ORIGIN WHERE THE AXES A AND C CROSS. TOOL LENGTH: TO THE CENTRE OF THE BALL)\n"
      "G21 G17 G90 G94 G40 G80 G54\n"
      "(LOGOPEN,touches.csv)\n"
      "(LOG,A_deg,C_deg,point,ball_x_mm,ball_y_mm,ball_z_mm)\n";
  const PlannedTouch* before = nullptr;
  for (const PlannedTouch& touch : plan.touches) {
    const std::string a = degrees(plan.tilts[touch.tilt]), c = degrees(plan.turns[touch.turn]);
    if (before == nullptr || before->tilt != touch.tilt || before->turn != touch.turn) {
      text += fmt::format("G0 Z{}\nG0 A{} C{}\n", safe, a, c);
    }
    const TouchPoint& point = touch_points().at(touch.point);
    const Mat3 rotation = plan.rotation(touch);
    const Vec3 normal = rotation * point.normal;
    const Vec3 contact = rotation * point.place + probe.ball_radius * normal;
    const Vec3 approach = contact + kTouchApproach * normal;
    text += fmt::format("G0 X{} Y{}\nG0 Z{}\nG38.2 {} F{:g}\n", fixed_decimal(approach.x(), 6),
                        fixed_decimal(approach.y(), 6), fixed_decimal(approach.z(), 6),
                        words_of(contact - kTouchApproach * normal), kFeed);
    text += fmt::format("(LOG,{},{},{},#5061,#5062,#5063)\nG0 {}\nG0 Z{}\n", a, c, touch.point,
                        words_of(approach), safe);
    before = &touch;
  }
  return text + "(LOGCLOSE)\nM2\n";
}

}  // namespace frustum::instruments

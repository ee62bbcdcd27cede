// One rotary axis turns, the linear axes follow, a ball bar reads in one of three directions.
//
// Model    : the tip is at b + L u, with the table ball b and the direction u of the bar:
//              axial       u = e, the axis
//              radial      of a table: from the axis through the table ball; of a head: from the
//                          spindle ball to the axis (the table ball is outside)
//              tangential  e x (arm from the axis to the ball that rides on the rotor)
//            hold = rotor: u turns with the axis; bed: u keeps the direction in the bed that it has
//            where the axis stands at zero. Where the ball is on the axis, the arm is the X of the
//            rotor
// Units    : mm, rad; frame: table
// Shape    : a pose an angle
// Errors   : a letter that is no rotary axis of the machine, a bar without length, poses out of
//            reach
// Accuracy : nominal positions to rounding
// Source   : ISO 10791-6 (BK1 to BK4), by its name
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

enum class BarDirection { axial, radial, tangential };
inline constexpr std::array<BarDirection, 3> kBarDirections{
    BarDirection::axial, BarDirection::radial, BarDirection::tangential};
[[nodiscard]] std::string_view name_of(BarDirection direction);
[[nodiscard]] std::optional<BarDirection> bar_direction_named(std::string_view text);

enum class BarHold { rotor, bed };
[[nodiscard]] std::string_view name_of(BarHold hold);

struct RotaryTest {
  kinematics::AxisLetter axis = kinematics::AxisLetter::C;
  BarDirection direction = BarDirection::radial;
  BarHold hold = BarHold::rotor;
  Vec3 table_ball = Vec3::Zero();
  double length = 150.0;
  std::vector<double> angles{};
  kinematics::AxisPositions held{};  // the other rotary axes
  double tool_length = 0.0;
};

[[nodiscard]] Result<MotionTest> rotary_test(const kinematics::Machine& machine,
                                             const RotaryTest& rotary);

// The hold with which the programmed tip stands still under tool centre point control: rotor on a
// table, bed on a head.
[[nodiscard]] BarHold standing_hold(const kinematics::Joint& axis);
// A full turn where the axis has one, else all of its travel.
[[nodiscard]] kinematics::AxisRange capture_of(const kinematics::Joint& axis);

}  // namespace frustum::instruments

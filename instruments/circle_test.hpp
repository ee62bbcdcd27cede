// Circles of two linear axes with a ball bar.
//
// Model    : the table ball is the centre; the tip runs at phi on
//              centre + L (cos phi e1 + sin phi e2)
//            where e1, e2 are the directions of the letters of the plane: XY, YZ or ZX, so that phi
//            runs from the first letter to the second (ZX: from Z to X, as in G18); ccw: phi grows.
//            With a feed v every axis follows its command with the steady lag of its gain K:
//              amplitude 1 / sqrt(1 + (v / L K)^2), phase atan(v / L K)
//            Rotary axes are held
// Units    : mm, rad, mm/s; frame: table
// Shape    : a pose an angle
// Errors   : a machine that lacks an axis of the plane, a bar without length, an arc out of reach
// Accuracy : nominal positions to rounding
// Source   : ISO 230-4
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

enum class Plane { XY, YZ, ZX };
inline constexpr std::array<Plane, 3> kPlanes{Plane::XY, Plane::YZ, Plane::ZX};
[[nodiscard]] std::string_view name_of(Plane plane);
[[nodiscard]] std::optional<Plane> plane_named(std::string_view text);
// First and second letter.
[[nodiscard]] std::array<kinematics::AxisLetter, 2> axes_of(Plane plane);

enum class Sense { ccw, cw };
inline constexpr std::array<Sense, 2> kSenses{Sense::ccw, Sense::cw};
// +1 ccw, -1 cw.
[[nodiscard]] constexpr double sign_of(Sense sense) { return sense == Sense::ccw ? 1.0 : -1.0; }
[[nodiscard]] std::string_view name_of(Sense sense);

struct CircleTest {
  Plane plane = Plane::XY;
  Sense sense = Sense::ccw;
  double length = 150.0;       // of the bar, the radius
  Vec3 centre = Vec3::Zero();  // table frame
  std::vector<double> angles{};
  kinematics::AxisPositions held{};  // rotary axes
  double tool_length = 0.0;
  std::optional<double> feed{};  // mm/s: with servo lag; without: the axes follow at once
};

[[nodiscard]] Result<MotionTest> circle_test(const kinematics::Machine& machine,
                                             const CircleTest& circle);

}  // namespace frustum::instruments

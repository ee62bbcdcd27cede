// Five axes at once on the circle of the cone test, with a ball bar in place of the cutter.
//
// Model    : tip at centre + Ry(inclination) (r cos phi, r sin phi, 0), tool along the generatrix
//            of the cone; sense of the bar:
//              radial  in the plane of the path, table ball in its centre, L = r
//              normal  along the surface normal, table ball on the cone's axis at -r tan(alpha),
//                      L = r / cos(alpha)
//            The rotary axes follow phi continuously from phi = 180 deg, where the tilt is
//            largest, to both sides; of two solutions that with the tilt axis below zero begins
// Units    : mm, rad; frame: table
// Shape    : a pose an angle
// Errors   : angles that make no cone, a machine without two rotary axes, poses out of reach
// Accuracy : nominal positions to rounding
// Source   : ETH thesis, sections 3.1 to 3.6; Hong, Ibaraki, Matsubara (bar normal to the surface)
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

enum class ConeSense { normal, radial };
[[nodiscard]] std::string_view name_of(ConeSense sense);

struct ConeTest {
  double cone_angle = 0.0;  // half apex angle
  double inclination = 0.0;
  double radius = 0.0;  // of the circle of the tip
  Vec3 centre = Vec3::Zero();
  ConeSense sense = ConeSense::normal;
  std::vector<double> angles{};  // phi
  double tool_length = 0.0;
};

[[nodiscard]] Result<MotionTest> cone_test(const kinematics::Machine& machine,
                                           const ConeTest& cone);

}  // namespace frustum::instruments

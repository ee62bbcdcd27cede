// The cone frustum tests: NAS 979, and the inclined cone with cylinder, reference faces and groove.
//
// Model    : the workpiece frame has its origin in the centre of the tool-tip circle and Z along
//            the cone's axis towards the apex; the tip runs on a circle of radius r, the tool axis
//            leans by the half apex angle alpha and touches the cone along a generatrix:
//              tip  (r cos phi, r sin phi, 0)         axis (-sin a cos phi, -sin a sin phi, cos a)
//              normal (cos a cos phi, cos a sin phi, sin a)   contact = tip - R normal
//            placed on the table by Rz(orientation) Ry(inclination) about `center`
// Units    : mm, rad
// Errors   : cone_frustum() refuses shapes that do not exist (a cone that comes to a point before
//            its height, angles outside (0, 90) deg) and, for the forms that need axes, poses that
//            the machine cannot reach
// Accuracy : chords of the finished circle within `chord_tolerance`
// Source   : ETH thesis, sections 3.1-3.6 and appendix A; NAS 979 parameters of its table 2.1
#pragma once

#include <optional>

#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/milling/posed_program.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

// NAS 979 as printed, or the tenth of it that machine builders accept by.
enum class ConeLimits { nas979, tenth };

struct ConeFrustum {
  Rad cone_angle{45.0 * kRadPerDeg};  // half apex angle
  Rad inclination{30.0 * kRadPerDeg};
  Rad orientation{};               // turns the test about the table's Z
  Mm radius{40.0};                 // of the tool-tip circle
  Vec3 center{-65.0, 0.0, 150.0};  // of that circle in the table frame
  Mm height{5.0};                  // of the cone along its axis
  Mm cylinder_height{6.0};         // of the cylinder below the cone
  Mm tool_diameter{12.0};
  Mm tool_length{150.0};
  std::optional<Rad> start_angle{};  // phi of approach and departure; default 0, or 180 deg when
      // cone angle and inclination are equal (the pole is at phi = 0)
  Mm allowance{0.2};              // left by roughing, normal to the surface
  Mm chord_tolerance{5e-6};       // of the finished surfaces
  double feed = 500.0;            // mm/min
  double spindle_speed = 8333.0;  // 1/min
  ProgramForm form = ProgramForm::vector;
  ConeLimits limits = ConeLimits::nas979;

  // 10 inch base diameter, 30 deg apex angle, 1 inch depth of cut, inclined by 10 deg.
  [[nodiscard]] static ConeFrustum nas979();
};

// Where the finished part's faces are, in the workpiece frame.
struct ConeGeometry {
  double cutter_radius = 0.0;
  double base_radius = 0.0, top_radius = 0.0;
  double base_z = 0.0, top_z = 0.0;  // of the cone; top_z is also the blank's top face
  double floor_z = 0.0;              // of the flange that the cylinder is on
  double blank_radius = 0.0, bottom_z = 0.0;
  double groove_floor_z = 0.0, groove_inner_y = 0.0;
};

[[nodiscard]] Result<ConeGeometry> geometry(const ConeFrustum& cone);

[[nodiscard]] Result<TestPiece> cone_frustum(const ConeFrustum& cone,
                                             const kinematics::Machine& machine,
                                             parser::Dialect dialect = parser::Dialect::fanuc);

// The inspection plan alone.
[[nodiscard]] metrology::InspectionPlan cone_plan(const ConeFrustum& cone,
                                                  const ConeGeometry& shape);

}  // namespace frustum::programs

// The rotary axes of a machine as one spherical triangle: tool axis to rotary angles and back.
//
// Model    : exp(w1 q1) exp(w2 q2) v = u. z = exp(w2 q2) v is at the angle theta = (w1, u) from w1
//            and at (w2, v) from w2: a triangle over the side (w1, w2) with the angles psi at w1
//            and eta at w2, on either side of that side (sign s = +1, -1):
//              q1 = azimuth of u about w1 - s psi,   q2 = -s eta - azimuth of v about w2
//            psi and eta are in [0, pi] and go smoothly with theta; written from the nearer pole
//            +-w1, so that nothing cancels there
// Units    : rad; frame: table
// Errors   : unreachable directions, by how much
// Accuracy : the direction within 1e-14, also beside the pole and at the edge of the reach;
//            Gauss-Newton steps restore what rotary axes nearly parallel to each other or to the
//            spindle lose
// Source   : Paden-Kahan subproblem 2 (Murray, Li, Sastry, section 3.2)
#pragma once

#include <array>
#include <numbers>
#include <optional>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/few.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// Positions of the rotary axes, as seen from the table: [0] is the one next to it.
using RotaryAngles = std::array<double, 2>;

// Nearer to the pole than this the first rotary axis cannot be distinguished from the direction's
// own rounding.
inline constexpr double kPole = 1e-10;  // rad

struct RotaryTriangle {
  double azimuth = 0.0;         // of u about the first axis; 0 at the pole
  double psi = 0.0, eta = 0.0;  // angles at the first and at the second axis
  double from_pole = 0.0;       // sine of the angle between u and the line of the first axis
  bool beyond_reach = false;    // psi and eta then belong to the nearest direction in reach
};

struct OrientationSolution {
  RotaryAngles angle{};        // some full turn
  std::array<bool, 2> free{};  // the tool axis does not depend on this axis here; its angle is 0
  double sign = 1.0;
};
using OrientationSolutions = Few<OrientationSolution, 2>;

class RotaryAxes {
 public:
  // The machine must outlive it.
  explicit RotaryAxes(const Machine& machine);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const Joint& joint(std::size_t i) const { return *joints_[i]; }
  [[nodiscard]] RotaryAngles angles(const AxisPositions& q) const;
  [[nodiscard]] AxisPositions with(AxisPositions q, const RotaryAngles& angles) const;

  [[nodiscard]] Vec3 tool_axis(const RotaryAngles& q) const;
  // The unit directions in the table frame about which +q1 and +q2 turn the tool axis.
  [[nodiscard]] const Vec3& first_axis() const { return w1_; }

  // Both solutions (one at the pole and at the edge of the reach, two otherwise).
  [[nodiscard]] Result<OrientationSolutions> solve(const Vec3& u) const;

  // For two axes.
  [[nodiscard]] RotaryTriangle triangle(const Vec3& u) const;
  [[nodiscard]] RotaryAngles angles(const RotaryTriangle& triangle, double sign) const;
  // The second angle that points the tool axis best towards u when the first is given; near `near`.
  [[nodiscard]] double second_for(const Vec3& u, double first, double near) const;
  // On which solution rotary positions lie.
  [[nodiscard]] double sign_at(const RotaryAngles& q) const;
  // By how much (rad) u is out of reach; 0 or less: it is in reach.
  [[nodiscard]] double shortfall(const Vec3& u) const;

 private:
  std::size_t count_ = 0;
  std::array<const Joint*, 2> joints_{};
  Vec3 w1_ = Vec3::UnitZ(), w2_ = Vec3::UnitX();
  Vec3 across_ = Vec3::UnitX(), normal_ = Vec3::UnitY();  // across: from w1 towards w2
  double cos_between_ = 0.0, sin_between_ = 1.0;          // of w1 and w2
  double rise_[2] = {0.0, 0.0};                           // w2 . (v -+ w1)
  double azimuth_of_v_ = 0.0;                             // about w2 (one axis: about w1)
  bool needs_polish_ = false;
  double v_off_axis_ = 1.0;  // sine of the angle between v and w2
};

// An axis without limits turns no farther than this from its zero: 1000 turns.
inline constexpr double kMostTurned = 2000.0 * std::numbers::pi;

// The angle shifted by full turns to be nearest to `near`.
[[nodiscard]] double nearest_turn(double angle, double near);
// The full turn within travel that is nearest to `near`; the nearest of all if none is within.
[[nodiscard]] double best_turn(const Joint& joint, double angle, double near);
// Where a word turns the axis that is at `near`. In one direction it turns by less than a full
// turn, and not at all when it is there but for rounding.
[[nodiscard]] double turn_to(const Joint& joint, double word, double near, parser::RotaryPath path);
[[nodiscard]] bool within_travel(const Joint& joint, double position);

}  // namespace frustum::kinematics

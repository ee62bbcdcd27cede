// The step machining patterns: straight side cuts in indexed positions whose steps tell a machine's
// kinematic errors apart.
//
// Model    : eleven patterns 1-a .. 7 on a tilting rotary table. Each cuts two reference steps a, b and
//            two steps c, d of its own in other table positions; a step is a side surface S and a bottom
//            surface B. Directions and table angles are written for a table tilting by A about machine X
//            and turning by C (direction map machine -> table M = Rz(C) Rx(A)); on other tables X stands
//            for the tilt axis, Y for its right angle in the horizontal plane
//            (centre, heights)  in the table frame moved to the crossing of tilt and turn axis
// Units    : mm, rad, mm/min, 1/min
// Errors   : step_pattern() refuses patterns that the workpiece does not carry, that cut the same
//            surfaces, and table positions or tool positions out of travel (axis and what is short)
// Accuracy : the commanded planes are exact
// Source   : Ibaraki, Sawada, Matsubara, Matsushita: machining tests to identify kinematic errors on
//            five-axis machine tools, section 3, tables 3 and 4
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "kinematics/machine.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

// Which edge of the tool makes the side surfaces S of steps c and d.
enum class SideCutBy : std::uint8_t { side_edge, bottom_edge };
enum class StepKind : std::uint8_t {
  step,     // S upright, B level: dL, dH, theta, phi
  chamfer,  // S leaning by 45 deg, no B: dL, theta
  side,     // S upright, no B: dL, theta
};

// One straight pass in one table position, tool axis along machine Z.
struct StepPass {
  double tilt = 0.0;          // rad, A
  double turn = 0.0;          // rad, C
  Vec3 feed = Vec3::UnitX();  // unit, machine directions
  Vec3 side = Vec3::UnitY();  // unit, machine: from the side edge's cut surface to the tool axis
};

// What makes a pattern: the same on every workpiece and machine.
struct StepPattern {
  std::string_view name;
  StepKind kind = StepKind::step;
  SideCutBy side_cut_by = SideCutBy::side_edge;
  StepPass a{}, b{}, c{}, d{};
  // Table directions: of Xw along the lines (its sense gives phi its sign) and from S_c to S_d.
  Vec3 along = Vec3::UnitX();
  Vec3 across = Vec3::UnitY();
};

// In the order 1-a, 1-b, 2-a, 2-b, 3, 4, 5-a, 5-b, 6-a, 6-b, 7.
[[nodiscard]] std::span<const StepPattern> step_patterns();
[[nodiscard]] const StepPattern* find_step_pattern(std::string_view name);

// Nominal size of one pattern on a workpiece.
struct StepSize {
  std::string pattern{};
  double height = 0.0;  // H: of bottom surface B (S for chamfer and side) above the tilt axis
  double width = 0.0;   // L: between S_c and S_d
  double length = 0.0;  // W: of the measured lines
  double reference_height = 0.0;  // H0: of the reference steps' bottoms
  double reference_width = 0.0;   // L0: between S_a and S_b
};

struct StepWorkpiece {
  int number = 0;
  std::string title{};
  double centre_x = 0.0, centre_y = 0.0;  // Cx, Cy at A = C = 0
  double step_height = 5.0;               // h
  double step_width = 5.0;                // l
  std::vector<StepSize> sizes{};

  [[nodiscard]] const StepSize* size(std::string_view pattern) const;
};

// Workpiece #1 (patterns 1-a, 1-b, 2-a, 2-b), #2 (3 or 4, 5-a, 5-b, 6-a, 6-b, 7) of the paper, with the
// nominal sizes that can be machined together (docs/reproduction.md tells where they differ from its
// Table 4).
[[nodiscard]] StepWorkpiece step_workpiece_1();
[[nodiscard]] StepWorkpiece step_workpiece_2();

struct StepTest {
  StepWorkpiece workpiece{};
  std::vector<std::string> patterns{};  // empty: all that the workpiece can carry together
  Mm tool_diameter{20.0};
  Mm tool_length{150.0};
  Mm allowance{0.1};  // radial depth of the semi-finishing pass; finishing runs on the same path
  double feed = 1000.0;
  double spindle_speed = 5000.0;
};

// One pass as the program cuts it, for setup sheets.
struct StepCut {
  std::string name{};  // "1-a c"; a reference shared by patterns names the first: "3 a"
  kinematics::AxisPositions from{}, to{};               // commanded, at the ends of the cut
  Vec3 tip_from = Vec3::Zero(), tip_to = Vec3::Zero();  // workpiece frame
  Vec3 tool_axis = Vec3::UnitZ();                       // workpiece frame
  std::uint32_t first_line = 0, last_line = 0;          // of the NC program
};

struct StepPiece {
  TestPiece piece{};
  std::vector<StepCut> cuts{};
};

[[nodiscard]] Result<StepPiece> step_pattern(const StepTest& test,
                                             const kinematics::Machine& machine);

}  // namespace frustum::programs

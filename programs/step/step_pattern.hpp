// The step machining patterns: straight side cuts in indexed positions whose steps show a machine's
// kinematic errors apart.
//
// Model    : eleven patterns 1-a .. 7 on a tilting rotary table. Each has two reference steps a, b
//            and two steps c, d of its own in other table positions; a step is a side surface S and
//            a bottom surface B. Directions and table angles are written for a table tilting by A
//            about machine X and turning by C (direction map machine -> table M = Rz(C) Rx(A)); on
//            other tables X represents the tilt axis, Y for the horizontal direction across it.
// Frames   : the workpiece frame has the table's directions (X: the tilt axis) at zero and its
//            origin on the crossing of tilt and turn axis; heights H are its z
// Units    : mm, rad, mm/min, 1/min
// Shape    : four passes a pattern; a piece has two cuts for each different pair of reference
//            steps, then two for each pattern, and as many operations
// Errors   : step_pattern() refuses machines without a tilting turning table, unknown patterns
//            (with the nearest name), patterns that the workpiece does not carry or that cut the
//            same surfaces, and every position out of travel at once (pattern, axis, and how much
//            is short)
// Accuracy : commanded positions agree with an independent computation to 1e-6 mm
//            (tests/programs/step_geometry_test.cpp)
// Source   : Ibaraki, Sawada, Matsubara, Matsushita: machining tests to identify kinematic errors
//            on five-axis machine tools, section 3, tables 3 and 4
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

// Which edge of the tool makes the side surfaces S of steps c and d.
enum class SideCutBy : std::uint8_t { side_edge, bottom_edge };
enum class StepKind : std::uint8_t {
  step,     // S upright, B level: dL, dH, theta, phi
  chamfer,  // S leaning by 45 deg, no B: dL, theta
  side,     // S upright, no B: dL, theta
};
enum class StepName : std::uint8_t { a, b, c, d };
[[nodiscard]] char to_char(StepName step);

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
  std::array<StepPass, 4> passes{};  // a, b, c, d
  // How far the tip is below the line S, perpendicular to the feed; free where the side edge cuts
  // S.
  double depth = 0.0;  // mm
  // Workpiece directions: of Xw along the lines S (its sense gives phi its sign), from S_c to S_d,
  // and from S_a to S_b.
  Vec3 along = Vec3::UnitX();
  Vec3 across = Vec3::UnitY();
  Vec3 across_reference = Vec3::UnitY();
  // Patterns with the same word share their reference steps; empty: the pattern has its own.
  std::string_view shared_reference{};
  // Patterns with the same word cut steps c and d into the same surfaces; empty: into its own.
  std::string_view shared_steps{};

  [[nodiscard]] const StepPass& pass(StepName step) const {
    return passes[static_cast<std::size_t>(step)];
  }
  // What its reference steps are called: its own name, or that of the shared ones.
  [[nodiscard]] std::string_view reference() const {
    return shared_reference.empty() ? name : shared_reference;
  }
};

// In the order 1-a, 1-b, 2-a, 2-b, 3, 4, 5-a, 5-b, 6-a, 6-b, 7.
[[nodiscard]] std::span<const StepPattern> step_patterns();
[[nodiscard]] const StepPattern* find_step_pattern(std::string_view name);
// Whether one workpiece cannot carry both: each would cut away what the other is measured by.
[[nodiscard]] bool cut_the_same_surfaces(const StepPattern& a, const StepPattern& b);
// Of the patterns named, the first for each different pair of reference steps: it cuts them.
[[nodiscard]] std::vector<const StepPattern*> reference_patterns(
    std::span<const std::string> patterns);

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
  double centre_x = 0.0, centre_y = 0.0;  // Cx, Cy at A = C = 0
  double step_height = 5.0;               // h
  double step_width = 5.0;                // l
  std::vector<StepSize> sizes{};
  // The finished body about the vertical through the centre; z as H.
  stock::LoftShape body{};

  [[nodiscard]] const StepSize* size(std::string_view pattern) const;
  [[nodiscard]] Vec3 centre() const { return {centre_x, centre_y, 0.0}; }
};

// Workpiece #1 (patterns 1-a, 1-b, 2-a, 2-b), #2 (3 or 4, 5-a, 5-b, 6-a, 6-b, 7) of the paper, with
// nominal sizes that can be machined together (docs/step-patterns.md says where they differ from
// its Table 4). Nothing for other numbers.
[[nodiscard]] std::optional<StepWorkpiece> step_workpiece(int number);
// The same workpiece, standing higher by `mm`.
[[nodiscard]] StepWorkpiece raised(StepWorkpiece workpiece, double mm);
// The patterns that one workpiece carries together: of two that cut the same surfaces the first.
[[nodiscard]] std::vector<std::string> patterns_together(const StepWorkpiece& workpiece);

// A nominal pass in the workpiece frame.
struct StepLine {
  Vec3 on_side = Vec3::Zero();  // on the line S, in the middle of its length
  Vec3 tip = Vec3::Zero();      // of the tool, there
  Vec3 feed = Vec3::UnitX();    // unit, as are the others
  Vec3 side = Vec3::UnitY();    // outward normal of what the side edge cuts
  Vec3 axis = Vec3::UnitZ();    // of the tool; outward normal of what the bottom edge cuts
};
// `depth`: of the tip below S, instead of the pattern's own.
[[nodiscard]] StepLine step_line(const StepWorkpiece& workpiece, const StepPattern& pattern,
                                 StepName step, double tool_radius,
                                 std::optional<double> depth = {});

struct StepTest {
  StepWorkpiece workpiece = *step_workpiece(1);
  std::vector<std::string> patterns{};  // empty: all that the workpiece carries together
  Mm tool_diameter{20.0};
  Mm tool_length{150.0};
  Mm allowance{0.5};       // on every face of the blank: more than the errors may move a cut
  Mm semi_finishing{0.1};  // depth of the semi-finishing pass; finishing runs on the same path
  double feed = 1000.0;
  double spindle_speed = 5000.0;
  Mm tolerance{0.020};            // of dL, dH, dL0
  Rad angle_tolerance{100.0e-6};  // of theta, phi
};

// One step as the program cuts it, for setup sheets.
struct StepCut {
  std::string name{};                      // "1-a c"; of shared reference steps: "ref a"
  std::string cuts{};                      // which edge leaves S, which B
  kinematics::AxisPositions from{}, to{};  // commanded, where the cut begins and ends
  Vec3 words_from = Vec3::Zero(), words_to = Vec3::Zero();  // X Y Z as the program says them
  Mat3 machine_from_workpiece = Mat3::Identity();           // directions, in this table position
  // The line S at its nominal length, and the middle of the one opposite; workpiece frame.
  Vec3 line_from = Vec3::Zero(), line_to = Vec3::Zero(), opposite = Vec3::Zero();
  double height = 0.0, width = 0.0;             // H and L, or H0 and L0
  std::uint32_t first_line = 0, last_line = 0;  // of the NC program
};

struct StepPiece {
  TestPiece piece{};
  std::vector<std::string> patterns{};
  std::vector<StepCut> cuts{};  // as machined
};

[[nodiscard]] Result<StepPiece> step_pattern(const StepTest& test,
                                             const kinematics::Machine& machine,
                                             parser::Dialect dialect = parser::Dialect::fanuc);

}  // namespace frustum::programs

// The S-shaped test piece: a wall whose flanks are ruled surfaces, twisted and bent like an S,
// milled by the flank of a cylindrical cutter. After ISO 10791-7, with control points of our own:
// no verdict by that standard.
//
// Model    : the workpiece frame is that of the control points; curve C0 is in z = 0, C1 in
//            z = height, clamped uniform cubic B-splines of 13 points; v = z / height. Flank B is
//            flank A turned by 180 deg about Z, unless points are given. The cutter goes along A
//            with u rising, then along B: to the left of its way is material (climb milling),
//            15 mm of straight lead at either end; once with 0.1 mm left, once without
// Units    : mm, rad
// Errors   : s_piece() refuses a cutter that does not fit, numbers out of range, and places out of
//            travel
// Accuracy : tool poses 1e-6 mm and 1e-8 (tests/programs/flank_milling_test.cpp)
// Source   : ISO 10791-7:2020 by name; the geometry is ours
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/spline_surface.hpp"
#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/milling/flank_milling.hpp"
#include "programs/milling/posed_program.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

// Both curves of a flank.
struct FlankCurves {
  std::vector<Vec3> lower{}, upper{};
};
// Control points of those who have others: of flank A and, if it is not A turned, of flank B.
struct ControlPoints {
  FlankCurves a{};
  std::optional<FlankCurves> b{};
};

struct SPiece {
  FlankMethod method = FlankMethod::three_point;
  Mm cutter{20.0};  // diameter
  Mm height{30.0};  // does not count where points are given
  Mm overhang{2.0};
  std::size_t blocks = 4000;       // of one finished flank
  Vec3 center{40.0, 25.0, 120.0};  // of the workpiece frame in the table frame
  Rad orientation{};               // turns the piece about the table's Z
  Mm tool_length{150.0};
  double feed = 600.0;            // mm/min
  double spindle_speed = 4000.0;  // 1/min
  ProgramForm form = ProgramForm::vector;
  Mm tolerance{0.1};  // ours
  std::optional<ControlPoints> points{};
};

struct SGeometry {
  std::array<SplineSurface, 2> flanks;  // A, B: normals out of the material
  double base = 0.0, top = 0.0;         // z of the curves
};
[[nodiscard]] Result<SGeometry> geometry(const SPiece& piece);

[[nodiscard]] Result<TestPiece> s_piece(const SPiece& piece, const kinematics::Machine& machine,
                                        parser::Dialect dialect = parser::Dialect::fanuc);

// The inspection plan alone.
[[nodiscard]] metrology::InspectionPlan s_plan(const SPiece& piece, const SGeometry& shape);

// What each method leaves at the points of the plan where the machine makes no error, mm.
struct MethodDeviation {
  FlankMethod method{};
  double lowest = 0.0, highest = 0.0, rms = 0.0;
};
[[nodiscard]] std::vector<MethodDeviation> method_deviations(const SPiece& piece,
                                                             const SGeometry& shape);

}  // namespace frustum::programs

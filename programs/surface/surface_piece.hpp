// A test piece of a user's own surface: a net of control points, milled with five axes.
//
// Model    : the surface is a net of B-splines (core/spline_surface.hpp) in the workpiece frame.
//            Two rows make a ruled surface, which the flank of a cylindrical cutter mills in one
//            pass; more rows a freeform one, which a ball-ended cutter mills pass by pass, to and
//            fro.
//            The blank is a sheet along the surface, with 0.3 mm left on it
// Units    : mm, rad
// Errors   : surface_piece() refuses nets that fold, cutters that do not fit, numbers out of range
//            and places out of travel
// Accuracy : an error-free machine leaves what the way of milling leaves, within 0.1 um
//            (tests/trials/surface_piece_test.cpp)
// Source   : ours
#pragma once

#include <optional>

#include "core/spline_surface.hpp"
#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/milling/flank_milling.hpp"
#include "programs/milling/posed_program.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

struct SurfacePiece {
  SplineSurface surface;
  std::optional<Mm> cutter{};  // diameter: 20 mm for flanks, 10 mm of a ball
  FlankMethod method = FlankMethod::three_point;
  Mm cusp{0.002};                       // between passes of a ball
  Rad lead{15.0 * kRadPerDeg};          // of a ball-ended cutter
  std::optional<std::size_t> blocks{};  // of one pass: 4000 of a flank, 400 of a ball
  Mm thickness{10.0};                   // of the sheet
  Vec3 center{0.0, 0.0, 120.0};         // of the workpiece frame in the table frame
  Rad orientation{};
  Mm tool_length{150.0};
  double feed = 600.0;
  double spindle_speed = 6000.0;
  ProgramForm form = ProgramForm::vector;
  Mm tolerance{0.1};
};

[[nodiscard]] Result<TestPiece> surface_piece(const SurfacePiece& piece,
                                              const kinematics::Machine& machine,
                                              parser::Dialect dialect = parser::Dialect::fanuc);

}  // namespace frustum::programs

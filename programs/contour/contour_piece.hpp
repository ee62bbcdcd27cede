// A contouring piece: circle, diamond, quadrilateral with sides of 3 deg and square, in levels one
// below the other, milled by the flank of an end mill with two axes at a time. Own dimensions,
// after ISO 10791-7: no verdict by that standard.
//
// Model    : the workpiece frame has its origin in the centre of the top face. Each level is L/20
//            deep (L: the size); from the top: a circle of diameter 0.5625 L, a diamond with half
//            diagonals of 0.4375 L on the axes, a square of 0.9375 L turned by +3 deg, a square of
//            L; through all of them, if asked for, a bore of 0.1875 L. The cutter's radius is L/16,
//            its tip 0.5 mm above each ledge: flanks alone are finished. It goes clockwise outside
//            (climb milling), from 20 mm before corner 0 to 20 mm past it, about the other corners
//            on arcs of its radius; the rotary axes stand at 0
// Units    : mm, rad
// Shape    : 360 points on the circle, 49 on each side from 5 to 5 mm off the corners, half way
//            down each level
// Errors   : contour_piece() refuses sizes of less than 60 mm, machines without axes X, Y, Z, and
//            places out of travel
// Accuracy : closed forms of tests/trials/contour_piece_test.cpp within 0.02 um and 0.02 urad
// Source   : ISO 10791-7 by name; dimensions are ours
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

struct ContourPiece {
  Mm size{160.0};
  bool bore = false;
  Vec3 center{0.0, 0.0, 120.0};  // of the top face in the table frame
  Mm tool_length{150.0};
  double feed = 600.0;            // mm/min
  double spindle_speed = 4000.0;  // 1/min
  Mm tolerance{0.02};             // of lengths and forms; ours
  Rad angle_tolerance{200e-6};
};

// A level with four corners, clockwise seen from above; side k goes from corner k to the next.
struct ContourPolygon {
  std::string_view name{};
  std::array<Vec3, 4> corners{};  // z 0
  [[nodiscard]] const Vec3& corner(std::size_t k) const { return corners[k % 4]; }
  [[nodiscard]] Vec3 along(std::size_t side) const;   // unit, as the cutter goes
  [[nodiscard]] Vec3 normal(std::size_t side) const;  // unit, out of the material
  [[nodiscard]] double length(std::size_t side) const;
};

struct ContourGeometry {
  double cutter_radius = 0.0, circle_radius = 0.0, bore_radius = 0.0;
  double level = 0.0;                        // depth of each
  std::array<ContourPolygon, 3> polygons{};  // diamond, quad, square
  // Where the circle and then the polygons end, and half way down each.
  [[nodiscard]] double floor(std::size_t level_index) const;
  [[nodiscard]] double middle(std::size_t level_index) const;
  double bottom = 0.0;  // of the blank
};

[[nodiscard]] Result<ContourGeometry> geometry(const ContourPiece& piece);

[[nodiscard]] Result<TestPiece> contour_piece(const ContourPiece& piece,
                                              const kinematics::Machine& machine,
                                              parser::Dialect dialect = parser::Dialect::fanuc);

// The inspection plan alone.
[[nodiscard]] metrology::InspectionPlan contour_plan(const ContourPiece& piece,
                                                     const ContourGeometry& shape);

}  // namespace frustum::programs

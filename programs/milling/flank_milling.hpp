// A ruled surface milled by the flank of a cylindrical cutter: where its axis goes, and what is
// left of the material where the machine makes no error.
//
// Model    : the axis goes through Pa = r(u - d, va) + R n(u - d, va) and
//            Pb = r(u + d, vb) + R n(u + d, vb), with the tip `overhang` beyond the ruling's foot:
//              two-point    va, vb = 0, 1                   d = 0
//              balanced     va, vb = (1 -+ 1/sqrt 2) / 2    d = 0
//              three-point  va, vb = (1 -+ sqrt 3 / 2) / 2  d such that the middle of Pa and Pb is
//                           R from the surface
//            What is finished is the parallel surface at R of the ruled surface of the axes. With D
//            the angle between the normals at the ends of a ruling, two points overcut by R D^2 / 8
//            half way up, balanced ones by half of it
// Units    : mm, rad
// Shape    : a surface with two rows, whose normals point out of the material, towards the cutter
// Errors   : a cutter that does not fit into the hollow of the surface
// Accuracy : 1e-9 mm of the third point; deviations within 1e-6 mm
//            (tests/programs/flank_milling_test.cpp)
// Source   : ours; two points, and corrections of them: Lartigue, Duc, Affouard 2003, CAD 35(4)
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/spline_surface.hpp"
#include "core/units.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::programs {

enum class FlankMethod { two_point, balanced, three_point };
inline constexpr std::array<std::string_view, 3> kFlankMethodNames{"two-point", "balanced",
                                                                   "three-point"};

struct FlankCutter {
  double radius = 10.0;   // mm
  double overhang = 2.0;  // mm, of the tip beyond v = 0
  FlankMethod method = FlankMethod::three_point;
};

struct FlankPose {
  kinematics::ToolPose pose{};
  double shift = 0.0;  // d, of u
};
// With the axis from tip to spindle.
[[nodiscard]] FlankPose flank_pose(const SplineSurface& surface, const FlankCutter& cutter,
                                   double u);

// From `lead` mm before the surface to as much past it, at equal steps of u: blocks + 1 poses.
[[nodiscard]] std::vector<FlankPose> flank_path(const SplineSurface& surface,
                                                const FlankCutter& cutter, double lead,
                                                std::size_t blocks);
// Length of the way of the tip.
[[nodiscard]] double length_of(const std::vector<FlankPose>& path);

// Where along u the surface is most hollow at a height v, and the largest radius that fits there;
// infinite where it is nowhere hollow.
struct NarrowestHollow {
  double u = 0.0;
  double radius = 0.0;  // mm
};
[[nodiscard]] NarrowestHollow narrowest_hollow(const SplineSurface& surface, double v = 0.5);
// Why the cutter does not fit, half way up or at an edge, with u and the largest radius that does;
// nothing where it does.
[[nodiscard]] std::optional<Diagnostic> does_not_fit(const SplineSurface& surface,
                                                     const FlankCutter& cutter);

// mm along the normal at (u, v), above 0 where material is left.
[[nodiscard]] double flank_deviation(const SplineSurface& surface, const FlankCutter& cutter,
                                     double u, double v);

}  // namespace frustum::programs

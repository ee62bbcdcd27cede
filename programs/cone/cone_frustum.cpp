#include "programs/cone/cone_frustum.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "programs/cone/cone_path.hpp"
#include "programs/piece_tool.hpp"

namespace frustum::programs {
namespace {

using kinematics::Machine;

constexpr double kFlange = 25.0;      // mm: thickness of the flange below the cylinder
constexpr double kGrooveDepth = 4.0;  // mm

Diagnostic refuse(DiagnosticId id, const char* key, const std::string& what,
                  const std::string& hint) {
  Diagnostic failure = error(id, what, hint);
  failure.key = key;
  return failure;
}

// Every number of the test within what a machine could do: checked before anything is generated.
std::optional<Diagnostic> check(const ConeFrustum& cone) {
  constexpr double kLongest = 5000.0;  // mm: larger than any machine that cuts this test
  const double a = cone.cone_angle.value;
  if (!(a > 0.0 && a < 0.5 * std::numbers::pi)) {
    return refuse("out-of-range"_id, "cone-angle",
                  fmt::format("a half apex angle of {:g} deg", a * kDegPerRad),
                  "it must be between 0 and 90 deg");
  }
  const struct {
    const char* key;
    double rad;
  } angles[] = {{"inclination", cone.inclination.value},
                {"orientation", cone.orientation.value},
                {"start-angle", cone.start_angle.value_or(Rad{}).value}};
  for (const auto& [key, rad] : angles) {
    if (!(std::abs(rad) <= 2.0 * std::numbers::pi)) {
      return refuse("out-of-range"_id, key, fmt::format("an angle of {:g} deg", rad * kDegPerRad),
                    "it must be within -360 .. 360 deg");
    }
  }
  const struct {
    const char* key;
    double mm, lowest;
  } lengths[] = {{"radius", cone.radius.value, 1.0},
                 {"height", cone.height.value, 1.5},
                 {"cylinder-height", cone.cylinder_height.value, 4.0},
                 {"tool-diameter", cone.tool_diameter.value, 1.0},
                 {"tool-length", cone.tool_length.value, 1.0},
                 {"allowance", cone.allowance.value, 0.0}};
  for (const auto& [key, mm, lowest] : lengths) {
    if (!(mm >= lowest && mm <= kLongest)) {
      return refuse("out-of-range"_id, key, fmt::format("{:g} mm", mm),
                    fmt::format("it must be between {:g} and {:g} mm", lowest, kLongest));
    }
  }
  if (!(cone.allowance.value < 0.5 * cone.tool_diameter.value)) {
    return refuse("cone-allowance"_id, "allowance", fmt::format("{:g} mm", cone.allowance.value),
                  "it must be less than the cutter's radius");
  }
  if (!(cone.center.allFinite() && cone.center.norm() < 10.0 * kLongest)) {
    return refuse("out-of-range"_id, "center", "the centre is out of any machine's reach",
                  "x,y,z in mm");
  }
  // The finest: about 70,000 chords on a circle of 100 mm.
  if (!(cone.chord_tolerance.value >= 1e-7 && cone.chord_tolerance.value <= 1.0)) {
    return refuse("out-of-range"_id, "chord-tolerance",
                  fmt::format("{:g} um", cone.chord_tolerance.value * kUmPerMm),
                  "it must be between 0.0001 and 1000 um");
  }
  if (!(cone.feed > 0.0 && cone.feed <= 1e5)) {
    return refuse("out-of-range"_id, "feed", fmt::format("{:g} mm/min", cone.feed),
                  "above 0, at most 100000");
  }
  if (!(cone.spindle_speed >= 1.0 && cone.spindle_speed <= 1e6)) {
    return refuse("out-of-range"_id, "speed", fmt::format("{:g} 1/min", cone.spindle_speed),
                  "the spindle must turn: 1 to 1000000");
  }
  return std::nullopt;
}

PosedProgramSettings settings_of(const ConeFrustum& cone) {
  PosedProgramSettings settings;
  settings.number = "0979";
  settings.title = "CONE FRUSTUM";
  settings.remarks = {
      fmt::format("CONE ANGLE {:g} DEG, INCLINATION {:g} DEG, TIP CIRCLE RADIUS {:g} MM",
                  cone.cone_angle.value * kDegPerRad, cone.inclination.value * kDegPerRad,
                  cone.radius.value),
      fmt::format("T1 = END MILL D{:g}, LENGTH {:g} MM", cone.tool_diameter.value,
                  cone.tool_length.value)};
  settings.piece = "the cone test";
  settings.remedy =
      "change --center, --radius, --orientation, --inclination or --tool-length, or choose a "
      "larger machine";
  settings.origin = cone.center;
  settings.tool_length = cone.tool_length;
  settings.feed = cone.feed;
  settings.spindle_speed = cone.spindle_speed;
  settings.form = cone.form;
  return settings;
}

}  // namespace

ConeFrustum ConeFrustum::nas979() {
  ConeFrustum cone;
  cone.cone_angle = {15.0 * kRadPerDeg};
  cone.inclination = {10.0 * kRadPerDeg};
  cone.tool_diameter = {25.0};
  cone.height = {25.4};
  cone.cylinder_height = {10.0};
  cone.feed = 635.0;
  cone.spindle_speed = 1800.0;
  // The base of the finished cone measures 10 inch; the tip runs outside by the cutter.
  cone.radius = {5.0 * kMmPerInch +
                 0.5 * cone.tool_diameter.value * std::cos(cone.cone_angle.value)};
  cone.center = Vec3(0.0, 0.0, 120.0);
  return cone;
}

Result<ConeGeometry> geometry(const ConeFrustum& cone) {
  if (const auto problem = check(cone)) return *problem;
  const double a = cone.cone_angle.value;
  ConeGeometry shape;
  const double cutter = 0.5 * cone.tool_diameter.value;
  shape.cutter_radius = cutter;
  shape.base_radius = cone.radius.value - cutter * std::cos(a);
  shape.base_z = -cutter * std::sin(a);
  shape.top_z = shape.base_z + cone.height.value;
  shape.top_radius = shape.base_radius - cone.height.value * std::tan(a);
  // The reference plane on top needs room for a ring of probed points.
  constexpr double kLeastTop = 5.0;
  if (shape.top_radius < kLeastTop) {
    return refuse(
        "cone-top"_id, "height",
        fmt::format("base radius {:.3f} mm and height {:g} mm leave a top of radius {:.3f} mm",
                    shape.base_radius, cone.height.value, shape.top_radius),
        "at least 5 mm are needed: a larger radius, or a smaller height or cone angle");
  }
  shape.floor_z = shape.base_z - cone.cylinder_height.value;
  shape.groove_floor_z = shape.floor_z - kGrooveDepth;
  shape.bottom_z = shape.floor_z - kFlange;
  shape.groove_inner_y = shape.base_radius + cutter + 2.0;
  // Flange: the groove, and a ring to probe; rounded up to 5 mm, as stock comes.
  shape.blank_radius = 5.0 * std::ceil((shape.base_radius + 3.0 * cutter) / 5.0);
  return shape;
}

Result<TestPiece> cone_frustum(const ConeFrustum& cone, const Machine& machine,
                               parser::Dialect dialect) {
  const auto shape = geometry(cone);
  if (!shape) return shape.error();
  TestPiece piece;
  piece.title = fmt::format("Cone frustum {:g}/{:g} deg on {}", cone.cone_angle.value * kDegPerRad,
                            cone.inclination.value * kDegPerRad, machine.name());
  piece.placement = {cone.center, Vec3(0.0, cone.inclination.value, cone.orientation.value)};
  piece.work_offsets = {{1, cone.center}, {kMachineOffset, Vec3::Zero()}};
  const double reach = (cone.height.value + 2.0) / std::cos(cone.cone_angle.value);
  const double flutes =
      std::max(reach, cone.height.value + cone.cylinder_height.value + kGrooveDepth);
  piece.tools[kPieceTool] =
      piece_tool(cone.tool_diameter, cone.tool_length, {std::ceil(flutes + 5.0)});
  piece.blank =
      stock::FrustumShape{shape->blank_radius, shape->blank_radius, shape->top_z - shape->bottom_z};
  piece.blank_origin = Vec3(0, 0, shape->bottom_z);
  piece.plan = cone_plan(cone, *shape);
  piece.program_file = "cone.nc";
  piece.error_span = "cone finishing";
  return write_posed_program(settings_of(cone), cone_path(cone, *shape), machine, std::move(piece),
                             dialect);
}

}  // namespace frustum::programs

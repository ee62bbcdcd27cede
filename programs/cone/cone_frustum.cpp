#include "programs/cone/cone_frustum.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "kinematics/model/inverse.hpp"
#include "programs/cone/cone_path.hpp"
#include "programs/cone/linearised_axes.hpp"
#include "programs/piece_program.hpp"
#include "programs/piece_tool.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

constexpr double kFlange = 25.0;      // mm: thickness of the flange below the cylinder
constexpr double kGrooveDepth = 4.0;  // mm
// Axis-position programs are cut fine enough that straight axis motion stays within this of the
// path.
constexpr double kLineariseTolerance = 2e-6;  // mm
constexpr int kTool = 1;
constexpr int kMachineOffset = 6;  // G59 = 0: axis positions as the machine shows them

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

// The blocks of one form of program.
class ConeProgram {
 public:
  ConeProgram(const ConeFrustum& cone, const Machine& machine)
      : cone_(cone), machine_(machine), axes_(machine.home()) {}

  Result<TestPiece> write(const ConeGeometry& shape, TestPiece piece, parser::Dialect dialect) {
    header();
    for (const PathOperation& op : cone_path(cone_, shape)) {
      begin_operation(op.name);
      for (const auto* moves : {&op.lead_in, &op.cut, &op.lead_out}) {
        const std::uint32_t first = nc_.next_block();
        for (const PathMove& move : *moves) {
          if (auto problem = add_move(move)) return *problem;
        }
        if (moves == &op.cut) {
          piece.operations.push_back({.name = op.name,
                                      .first_line = first,
                                      .last_line = nc_.next_block() - 1,
                                      .kind = op.kind});
        }
      }
    }
    footer();
    const auto written = nc_.write(piece, dialect);
    if (!written) return written.error();
    return piece;
  }

 private:
  void header() {
    nc_.comment(fmt::format("CONE ANGLE {:g} DEG, INCLINATION {:g} DEG, TIP CIRCLE RADIUS {:g} MM",
                            cone_.cone_angle.value * kDegPerRad,
                            cone_.inclination.value * kDegPerRad, cone_.radius.value));
    nc_.comment(fmt::format("T1 = END MILL D{:g}, LENGTH {:g} MM", cone_.tool_diameter.value,
                            cone_.tool_length.value));
    nc_.without_compensation();
    nc_.block({parser::ToolChange{kTool}});
    nc_.block({parser::SpindleChange{parser::SpindleDirection::clockwise, cone_.spindle_speed}});
  }

  // Every operation starts from the rotary axes' home, so that none inherits turns from the one
  // before.
  void begin_operation(const std::string& name) {
    nc_.comment(name);
    retract();
    const AxisPositions home = machine_.home();
    parser::AxisTarget rotary_home;
    add_rotary(rotary_home, home);
    if (rotary_home != parser::AxisTarget{}) nc_.block({machine_traverse(rotary_home)});
    for (const AxisLetter letter : parser::kRotaryAxes) axes_[letter] = home[letter];
    axes_[AxisLetter::Z] = home[AxisLetter::Z];
    using enum parser::LengthCompensation;
    switch (cone_.form) {
      case ProgramForm::vector:
        begin_frame(1, {.mode = tool_centre_point, .tool_vectors = true, .offset_number = kTool});
        break;
      case ProgramForm::angles:
        begin_frame(1, {.mode = tool_centre_point, .offset_number = kTool});
        break;
      case ProgramForm::axes:
        nc_.comment("G59 is the machine's own origin: words are axis positions of the tool tip");
        begin_frame(kMachineOffset, {.mode = length, .offset_number = kTool});
        break;
    }
  }

  void begin_frame(int work_offset, const parser::CompensationChange& compensation) {
    nc_.block({compensation, parser::WorkOffsetChange{work_offset}});
  }

  void retract() {
    nc_.block({parser::CompensationChange{}});
    parser::AxisTarget up;
    up[AxisLetter::Z] = machine_.joint(AxisLetter::Z)->home;
    nc_.block({machine_traverse(up)});
  }

  void footer() {
    retract();
    nc_.block({parser::SpindleChange{}});
    nc_.block({parser::Stop{}});
  }

  std::optional<Diagnostics> add_move(const PathMove& move) {
    const kinematics::ToolPose in_table{move.pose.tip + cone_.center, move.pose.axis};
    const auto solutions = kinematics::inverse(machine_, in_table, cone_.tool_length.value, axes_);
    if (!solutions) return solutions.error();
    const AxisPositions next = solutions->front().axes;
    if (!solutions->front().within_travel) {
      return Diagnostics{
          error("axis-over-travel"_id,
                fmt::format("the cone test does not fit on machine {}: {}", machine_.name(),
                            fmt::join(kinematics::travel_violations(machine_, next), "; ")),
                "change --center, --radius or --orientation, or choose a larger machine")};
    }
    if (cone_.form == ProgramForm::vector) {
      add_block(move, tip_target(move.pose.tip), UnitVec3::of(move.pose.axis));
    } else if (cone_.form == ProgramForm::angles) {
      parser::AxisTarget target = tip_target(move.pose.tip);
      add_rotary(target, next);
      add_block(move, target);
    } else {
      for (const AxisPositions& q :
           linearised(machine_, axes_, next, cone_.tool_length.value, kLineariseTolerance)) {
        add_block(move, axis_target(q));
      }
    }
    axes_ = next;
    return std::nullopt;
  }

  void add_rotary(parser::AxisTarget& target, const AxisPositions& q) const {
    for (const AxisLetter letter : parser::kRotaryAxes) {
      if (machine_.joint(letter) != nullptr) target[letter] = q[letter];
    }
  }

  // Words of G59 with G43: at rotary zero they are the tip's place in the table frame.
  [[nodiscard]] parser::AxisTarget axis_target(const AxisPositions& q) const {
    const AxisPositions origin =
        kinematics::place_tip(machine_, Vec3::Zero(), cone_.tool_length.value, {});
    parser::AxisTarget target = tip_target({q[AxisLetter::X] - origin[AxisLetter::X],
                                            q[AxisLetter::Y] - origin[AxisLetter::Y],
                                            q[AxisLetter::Z] - origin[AxisLetter::Z]});
    add_rotary(target, q);
    return target;
  }

  void add_block(const PathMove& move, const parser::AxisTarget& end,
                 const std::optional<UnitVec3>& tool_axis = {}) {
    if (move.rapid) {
      nc_.block({parser::Traverse{.end = end, .tool_axis = tool_axis}});
    } else {
      nc_.block({parser::LinearFeed{.end = end, .tool_axis = tool_axis, .feed = {cone_.feed}}});
    }
  }

  const ConeFrustum& cone_;
  const Machine& machine_;
  AxisPositions axes_;
  PieceProgram nc_{"0979", "CONE FRUSTUM"};
};

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
  piece.tools[kTool] = piece_tool(cone.tool_diameter, cone.tool_length, {std::ceil(flutes + 5.0)});
  piece.blank =
      stock::FrustumShape{shape->blank_radius, shape->blank_radius, shape->top_z - shape->bottom_z};
  piece.blank_origin = Vec3(0, 0, shape->bottom_z);
  piece.plan = cone_plan(cone, *shape);
  piece.program_file = "cone.nc";
  piece.error_span = "cone finishing";
  return ConeProgram(cone, machine).write(*shape, std::move(piece), dialect);
}

}  // namespace frustum::programs

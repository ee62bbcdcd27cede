#include "app/motion/setup_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/motion/bar_clearance.hpp"
#include "core/constants.hpp"
#include "core/decimal.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

std::string place_text(const Vec3& v) {
  return fmt::format("X {} Y {} Z {}", fixed_decimal(v.x(), 3), fixed_decimal(v.y(), 3),
                     fixed_decimal(v.z(), 3));
}

// Corners of a body in the frame of the table.
std::vector<Vec3> corners_of(const kinematics::MachineBody& body, const Pose& table_from_part) {
  std::vector<Vec3> corners;
  if (const auto* box = std::get_if<kinematics::BoxBody>(&body.shape)) {
    for (int k = 0; k < 8; ++k) {
      corners.emplace_back(((k & 1) != 0 ? 0.5 : -0.5) * box->size.x(),
                           ((k & 2) != 0 ? 0.5 : -0.5) * box->size.y(),
                           (k & 4) != 0 ? box->size.z() : 0.0);
    }
  } else if (const auto* round = std::get_if<kinematics::CylinderBody>(&body.shape)) {
    constexpr int kCorners = 48;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = kTurn * k / kCorners, r = 0.5 * round->diameter;
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle), round->height);
    }
  }
  for (Vec3& corner : corners) corner = (table_from_part * body.part_from_body).point(corner);
  return corners;
}

// The line of a rotary axis in the frame of the table, with the direction about which its part
// turns as it grows.
std::optional<report::BarDrawing::Axis> turning_axis(const kinematics::Machine& machine,
                                                     const std::string& letter_text,
                                                     const kinematics::AxisPositions& q) {
  const auto letter = kinematics::axis_named(letter_text);
  const kinematics::Joint* joint = letter ? machine.joint(*letter) : nullptr;
  if (joint == nullptr || !joint->rotary()) return std::nullopt;
  const kinematics::GeometricErrors none;
  const kinematics::ForwardChain nominal(machine, none, 0.0);
  constexpr double kStep = 0.5;  // rad: far from nothing and from half a turn
  kinematics::AxisPositions on = q;
  on[*letter] += kStep;
  const auto part = [&](const kinematics::AxisPositions& at) {
    return joint->side > 0 ? nominal.bed_from_tool(at) : nominal.bed_from_table(at);
  };
  const Pose moved = part(on) * part(q).inverse();
  const Mat3& r = moved.rotation;
  const Vec3 direction = Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)).normalized();
  const Vec3 across = moved.translation - moved.translation.dot(direction) * direction;
  const Vec3 point = 0.5 * (across + direction.cross(across) / std::tan(0.5 * kStep));
  const Pose table_from_bed = nominal.bed_from_table(q).inverse();
  return report::BarDrawing::Axis{table_from_bed.point(point), table_from_bed.direction(direction)};
}

// What is on the table, with the bar where the program stops for it.
report::BarDrawing drawing_of(const SetupSheet& sheet, const programs::BarPass& pass) {
  const auto& machine = sheet.machine;
  const auto& test = sheet.test;
  report::BarDrawing drawing{.title = "Set-up on the table",
                             .table_ball = test.table_ball,
                             .offset = sheet.program.work_offsets.at(1),
                             .tool_length = test.tool_length,
                             .parameter = sheet.parameter + " grows"};
  constexpr int kLooks = 180;
  constexpr double kFeedIn = 1.5;  // mm
  for (int i = 0; i <= kLooks; ++i) {
    const auto q = test.motion.axes(std::lerp(pass.from, pass.to, i / double{kLooks}));
    const Pose tool = nominal_pose(machine, q, test.tool_length);
    if (i == 0) {
      drawing.tool_axis = tool.rotation.col(2);
      const Vec3 outward = (tool.translation - test.table_ball).normalized();
      drawing.path.push_back(tool.translation + kFeedIn * outward);
    }
    drawing.path.push_back(tool.translation);
  }
  drawing.turning = turning_axis(machine, sheet.parameter, test.motion.axes(pass.from));
  const kinematics::MachinePart table{-1, machine.work_chain().size()};
  const Pose table_from_part = Pose::translated(-machine.table_offset());
  for (const kinematics::MachineBody& body : machine.bodies()) {
    const bool on_bed = table.joints == 0 && body.part.side == 0;
    if (!on_bed && !(body.part == table)) continue;
    drawing.bodies.push_back({body.name, corners_of(body, table_from_part)});
  }
  return drawing;
}

}  // namespace

std::optional<Diagnostics> add_setup_sheet(MotionAnswer& answer, const SetupSheet& sheet) {
  const auto& [machine, test, program, parameter, stroke, readings] = sheet;
  report::MotionTable table{.heading = "Set-up sheet", .columns = {"what", "where or how much"}};
  std::string csv = "what,value\n";
  const auto row = [&](const std::string& what, const std::string& value) {
    table.rows.push_back({what, value});
    csv += fmt::format("\"{}\",\"{}\"\n", what, value);
  };
  const Vec3& origin = program.work_offsets.at(1);
  const auto positions = place_tip(machine, origin, 0.0, {});
  row("NC program", program.program_file);
  row("G54 in the frame of the table, mm", place_text(origin));
  row("G54 in machine coordinates, without tool, mm",
      place_text({positions[kinematics::AxisLetter::X], positions[kinematics::AxisLetter::Y],
                  positions[kinematics::AxisLetter::Z]}));
  row("T1: spindle ball, length, mm", fmt::format("{:g}", test.tool_length));
  row("table ball in the frame of the table, mm", place_text(test.table_ball));
  row("bar, mm", fmt::format("{}", fixed_decimal(test.bar, 3)));
  const auto [least, most] =
      std::ranges::minmax_element(test.poses, {}, &instruments::TestPose::parameter);
  const programs::BarPass pass = programs::pass_of(machine, test);
  row("capture, deg of " + parameter,
      fmt::format("{:.6g} to {:.6g}", least->parameter * kDegPerRad, most->parameter * kDegPerRad));
  row("with overshoot, deg", fmt::format("{:g} to {:g}", as_stated(pass.from * kDegPerRad),
                                         as_stated(pass.to * kDegPerRad)));
  constexpr int kLooks = 720;  // of a pass, for the travels that it takes
  Document travels;
  for (const kinematics::Joint& joint : machine.joints()) {
    double low = 0.0, high = 0.0;
    for (int i = 0; i <= kLooks; ++i) {
      const double q =
          test.motion.axes(pass.from + (pass.to - pass.from) * i / kLooks)[joint.letter];
      low = i == 0 ? q : std::min(low, q);
      high = i == 0 ? q : std::max(high, q);
    }
    const double unit = joint.rotary() ? kDegPerRad : 1.0;
    const std::string name(1, to_char(joint.letter));
    row(fmt::format("{}, {}", name, joint.rotary() ? "deg" : "mm"),
        joint.endless
            ? fmt::format("{:.3f} to {:.3f}, endless", low * unit, high * unit)
            : fmt::format("{:.3f} to {:.3f} of {:g} to {:g}", low * unit, high * unit,
                          as_stated(joint.travel.lo * unit), as_stated(joint.travel.hi * unit)));
    travels[name] = std::vector<double>{low * unit, high * unit};
  }
  double largest = 0.0;
  for (const double reading : readings) largest = std::max(largest, std::abs(reading));
  row("largest reading, of the stroke",
      fmt::format("{:.1f} um of {:g} um", largest * kUmPerMm, stroke * kUmPerMm));
  const auto clearance = bar_clearance(machine, test, pass);
  if (!clearance) return clearance.error();
  if (*clearance && !((*clearance)->distance > 0.0)) {
    const BarClearance& met = **clearance;
    return Diagnostics{error(
        "setup-collides"_id,
        fmt::format("{} and {} meet at {} = {:.4g} deg", met.first, met.second, parameter,
                    met.parameter * kDegPerRad),
        "put the table ball higher or farther from there, take a longer tool, or capture less "
        "(--angles)")};
  }
  std::string nearest = "the machine file has no bodies: not looked for";
  if (*clearance) {
    nearest = fmt::format("{:.1f} mm between {} and {}, at {:.4g} deg", (*clearance)->distance,
                          (*clearance)->first, (*clearance)->second,
                          as_stated((*clearance)->parameter * kDegPerRad));
  }
  row("nearest approach", nearest);
  if (const double least_angle = least_angle_at_stem(machine, test, pass);
      least_angle < kBarBesideStem) {
    answer.warnings.push_back(warning(
        "bar-along-stem"_id,
        fmt::format("the bar comes within {:.3g} deg of the stem of its own spindle ball, above "
                    "which the spindle is",
                    least_angle * kDegPerRad),
        "capture less (--angles): upright circles are usually run from -20 to 200 deg"));
  }
  table.note =
      "The bar is mounted 1.5 mm too long, where the program stops. Travels are those of the pass.";
  if (*clearance && !(*clearance)->spindle) {
    table.note += fmt::format(
        " Without a tool length of {:g} mm or more the spindle is not looked at.", kLeastStem);
  }
  answer.page.setup = drawing_of(sheet, pass);
  answer.document["setup_sheet"] =
      Document{{"g54_in_table_mm", coordinates(origin)},
               {"capture_deg",
                std::vector<double>{least->parameter * kDegPerRad, most->parameter * kDegPerRad}},
               {"pass_deg", std::vector<double>{pass.from * kDegPerRad, pass.to * kDegPerRad}},
               {"travels", travels},
               {"largest_reading_um", largest * kUmPerMm},
               {"stroke_um", stroke * kUmPerMm},
               {"nearest_mm", *clearance ? std::optional((*clearance)->distance) : std::nullopt},
               {"nearest", nearest}};
  answer.page.tables.push_back(std::move(table));
  answer.files["setup.csv"] = std::move(csv);
  return std::nullopt;
}

}  // namespace frustum::app

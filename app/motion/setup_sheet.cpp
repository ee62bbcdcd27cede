#include "app/motion/setup_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

std::string place_text(const Vec3& v) {
  return fmt::format("X {} Y {} Z {}", fixed_decimal(v.x(), 3), fixed_decimal(v.y(), 3),
                     fixed_decimal(v.z(), 3));
}

}  // namespace

void add_setup_sheet(MotionAnswer& answer, const SetupSheet& sheet) {
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
  table.note =
      "The bar is mounted 1.5 mm too long, where the program stops. Travels are those of the pass; "
      "collisions with the table are not looked for.";
  answer.document["setup_sheet"] =
      Document{{"g54_in_table_mm", coordinates(origin)},
               {"capture_deg",
                std::vector<double>{least->parameter * kDegPerRad, most->parameter * kDegPerRad}},
               {"pass_deg", std::vector<double>{pass.from * kDegPerRad, pass.to * kDegPerRad}},
               {"travels", travels},
               {"largest_reading_um", largest * kUmPerMm},
               {"stroke_um", stroke * kUmPerMm}};
  answer.page.tables.push_back(std::move(table));
  answer.files["setup.csv"] = std::move(csv);
}

}  // namespace frustum::app

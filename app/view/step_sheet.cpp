#include "app/view/step_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "programs/step/tilting_table.hpp"

namespace frustum::app {
namespace {

using programs::StepCut;
using stock::LoftSection;

std::array<Vec3, 4> corners(const LoftSection& s, const Vec3& origin) {
  std::array<Vec3, 4> all;
  constexpr std::array<std::array<double, 2>, 4> kSigns{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    all[i] = origin + Vec3(0.5 * kSigns[i][0] * s.size_x, 0.5 * kSigns[i][1] * s.size_y, s.z);
  }
  return all;
}

// Walls and ledges are the same: strips between successive sections.
std::vector<report::SheetFace> faces_of(const stock::LoftShape& body, const Vec3& origin) {
  std::vector<report::SheetFace> faces;
  for (std::size_t i = 0; i + 1 < body.sections.size(); ++i) {
    const auto low = corners(body.sections[i], origin);
    const auto high = corners(body.sections[i + 1], origin);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      faces.push_back({low[k], low[next], high[next], high[k]});
    }
  }
  const auto top = corners(body.sections.back(), origin);
  faces.push_back({top[0], top[1], top[2], top[3]});
  const auto bottom = corners(body.sections.front(), origin);
  faces.push_back({bottom[3], bottom[2], bottom[1], bottom[0]});
  return faces;
}

}  // namespace

report::SetupSheet sheet_of(const programs::StepTest& test, const programs::StepPiece& made,
                            const kinematics::Machine& machine) {
  report::SetupSheet sheet;
  const programs::TestPiece& piece = made.piece;
  sheet.title = piece.title;
  // A test that was made has a table of this kind.
  const programs::TiltingTable table = *programs::TiltingTable::of(machine);
  sheet.tilt_axis = to_char(table.tilt);
  sheet.turn_axis = to_char(table.turn);
  sheet.tilts_about_x = table.orientation == 0.0;
  sheet.table_from_workpiece = piece.placement.table_from_workpiece().rotation;
  sheet.workpiece = faces_of(test.workpiece.body, test.workpiece.centre());
  sheet.tool_radius = 0.5 * test.tool_diameter.value;
  sheet.tool_length = piece.tools.begin()->second.flute_length.value;

  const auto& sections = test.workpiece.body.sections;
  const double bottom = sections.front().z, top = sections.back().z;
  const Vec3 centre = sheet.table_from_workpiece * test.workpiece.centre();
  const auto add = [&](const char* heading, const std::string& text) {
    sheet.facts.emplace_back(heading, text);
  };
  add("Machine", fmt::format("{}, {} ({})", machine.name(), machine.title(), machine.structure()));
  add("Workpiece", fmt::format("#{}: base {:g} x {:g} mm, {:g} mm high, {:g} mm left on every face",
                               test.workpiece.number, sections.front().size_x,
                               sections.front().size_y, top - bottom, test.allowance.value));
  add("Placed",
      fmt::format("centre at X {:.3f} Y {:.3f} from the crossing of {} and {}, bottom {:g} "
                  "and top {:g} mm above it{}",
                  centre.x(), centre.y(), sheet.tilt_axis, sheet.turn_axis, bottom, top,
                  sheet.tilts_about_x ? "" : ", turned by 90 deg about Z"));
  add("Work offset", fmt::format("G54 on that crossing, with {} and {} at zero", sheet.tilt_axis,
                                 sheet.turn_axis));
  add("Tool", fmt::format("T1 H1: end mill D{:g}, gauge length {:g} mm, cutting {:g} mm",
                          test.tool_diameter.value, test.tool_length.value, sheet.tool_length));
  add("Cutting",
      fmt::format("S{:g} 1/min, F{:g} mm/min, coolant on, climb milling; roughing leaves {:g} mm, "
                  "semi-finishing and finishing on one path",
                  test.spindle_speed, test.feed, test.semi_finishing.value));
  add("Program", piece.program_file);

  for (const StepCut& cut : made.cuts) {
    report::SheetStep step;
    step.name = cut.name;
    step.cuts = cut.cuts;
    step.table = fmt::format("{}{:g} {}{:g}", sheet.tilt_axis, cut.from[table.tilt] * kDegPerRad,
                             sheet.turn_axis, cut.from[table.turn] * kDegPerRad);
    step.size = fmt::format("H {:g}, L {:g}", cut.height, cut.width);
    step.machine_from_workpiece = cut.machine_from_workpiece;
    step.from = cut.words_from;
    step.to = cut.words_to;
    step.line_from = cut.line_from;
    step.line_to = cut.line_to;
    step.opposite = cut.opposite;
    step.height = cut.height;
    step.width = cut.width;
    step.first_line = cut.first_line;
    step.last_line = cut.last_line;
    sheet.steps.push_back(std::move(step));
  }
  return sheet;
}

}  // namespace frustum::app

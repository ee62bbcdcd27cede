#include "programs/step/step_pattern.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"
#include "programs/piece_tool.hpp"
#include "programs/step/near_net_blank.hpp"
#include "programs/step/step_plan.hpp"
#include "programs/step/step_program.hpp"
#include "programs/step/tilting_table.hpp"

namespace frustum::programs {
namespace {

Diagnostic refuse(DiagnosticId id, const char* key, const std::string& what,
                  const std::string& hint) {
  Diagnostic failure = error(id, what, hint);
  failure.key = key;
  return failure;
}

// Every number within what a machine could do: checked before anything is computed from it.
Diagnostics faults_of(const StepTest& test) {
  constexpr double kLongest = 2000.0;  // mm: beyond any machine that cuts this test
  // Narrower than the ledge of a base, a tool leaves skin; wider, on workpiece 2 the bottom of the
  // tool of pattern 6 would reach the line of pattern 7, and its rim that of pattern 5.
  const double widest = test.workpiece.number == 2 ? 21.0 : 40.0;
  const struct {
    const char* key;
    const char* unit;
    double value, lowest, highest;
  } numbers[] = {
      {"tool-diameter", "mm", test.tool_diameter.value, 16.0, widest},
      {"tool-length", "mm", test.tool_length.value, 50.0, kLongest},
      {"allowance", "mm", test.allowance.value, 0.001, 1.0},
      {"feed", "mm/min", test.feed, 1e-3, 1e5},
      {"speed", "1/min", test.spindle_speed, 1.0, 1e6},
      {"center", "mm", test.workpiece.centre_x, -kLongest, kLongest},
      {"center", "mm", test.workpiece.centre_y, -kLongest, kLongest},
      {"raise", "mm for the lowest level", test.workpiece.body.sections.front().z, -kLongest,
       kLongest},
      {"tolerance", "um", test.tolerance.value * kUmPerMm, 1e-6, 1e6},
      {"angle-tolerance", "urad", test.angle_tolerance.value * kUradPerRad, 1e-6, 1e6},
  };
  Diagnostics faults;
  for (const auto& n : numbers) {
    if (n.value >= n.lowest && n.value <= n.highest) continue;
    faults.push_back(refuse("out-of-range"_id, n.key, fmt::format("{:g} {}", n.value, n.unit),
                            fmt::format("it must be between {:g} and {:g}", n.lowest, n.highest)));
  }
  return faults;
}

std::vector<std::string> names_of(std::span<const StepPattern> patterns) {
  std::vector<std::string> names;
  for (const StepPattern& pattern : patterns) names.emplace_back(pattern.name);
  return names;
}

// The patterns asked for, in the order of the table.
Result<std::vector<std::string>> chosen(const StepTest& test) {
  const StepWorkpiece& piece = test.workpiece;
  if (test.patterns.empty()) return patterns_together(piece);
  std::vector<std::string> carried;
  for (const StepSize& size : piece.sizes) carried.push_back(size.pattern);
  Diagnostics faults;
  for (const std::string& name : test.patterns) {
    if (find_step_pattern(name) == nullptr) {
      faults.push_back(refuse("unknown-name"_id, "patterns",
                              fmt::format("there is no pattern '{}'", name),
                              suggestion(name, names_of(step_patterns()))));
    } else if (piece.size(name) == nullptr) {
      faults.push_back(
          refuse("step-pattern"_id, "patterns",
                 fmt::format("workpiece {} does not carry pattern {}", piece.number, name),
                 fmt::format("it carries {}; write one test piece for each workpiece",
                             fmt::join(carried, ", "))));
    }
  }
  const auto asked = [&](std::string_view name) {
    return std::find(test.patterns.begin(), test.patterns.end(), name) != test.patterns.end();
  };
  std::vector<std::string> names;
  for (const StepPattern& pattern : step_patterns()) {
    if (!asked(pattern.name)) continue;
    for (const std::string& other : names) {
      if (!cut_the_same_surfaces(pattern, *find_step_pattern(other))) continue;
      faults.push_back(
          refuse("step-pattern"_id, "patterns",
                 fmt::format("patterns {} and {} cut the same surfaces of workpiece {}", other,
                             pattern.name, piece.number),
                 "cut one of them, or write a test piece for each"));
    }
    names.emplace_back(pattern.name);
  }
  if (!faults.empty()) return faults;
  return names;
}

}  // namespace

Result<StepPiece> step_pattern(const StepTest& test, const kinematics::Machine& machine,
                               parser::Dialect dialect) {
  if (Diagnostics faults = faults_of(test); !faults.empty()) return faults;
  const auto patterns = chosen(test);
  if (!patterns) return patterns.error();
  const auto table = TiltingTable::of(machine);
  if (!table) return table.error();

  StepPiece made;
  made.patterns = *patterns;
  TestPiece& piece = made.piece;
  piece.title = fmt::format("Step patterns {} on {}", fmt::join(*patterns, " "), machine.name());
  piece.placement = {table->crossing, Vec3(0.0, 0.0, table->orientation)};
  piece.work_offsets = {{1, table->crossing}};
  // The tallest wall that the side edge passes, and some.
  constexpr double kFlutes = 45.0;
  piece.tools[kStepTool] = piece_tool(test.tool_diameter, test.tool_length, {kFlutes});
  const stock::LoftShape blank = near_net_blank(test.workpiece.body, test.allowance.value);
  piece.blank = blank;
  piece.blank_origin = test.workpiece.centre();
  piece.plan = step_plan(test, *patterns);
  piece.program_file = "step.nc";

  auto places = StepPlaces::of(test, *patterns, machine, *table, blank, piece.placement);
  if (!places) return places.error();
  const PieceProgram program = step_program(test, *patterns, machine, *table, *places);
  for (const StepPlace& place : places->steps) {
    piece.operations.push_back(
        {place.name, place.cut.first_line, place.cut.last_line, place.makes});
    made.cuts.push_back(place.cut);
  }
  if (const auto written = program.write(piece, dialect); !written) return written.error();
  for (std::size_t i = 0; i < made.cuts.size(); ++i) {
    made.cuts[i].first_line = piece.operations[i].first_line;
    made.cuts[i].last_line = piece.operations[i].last_line;
  }
  return made;
}

}  // namespace frustum::programs

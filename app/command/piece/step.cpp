// frustum program step: writes a step pattern test piece and its setup sheet.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "app/view/step_sheet.hpp"
#include "programs/step/step_pattern.hpp"
#include "programs/test_piece_files.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::StepTest;
namespace fs = std::filesystem;

// What was given on the command line; the rest comes from the workpiece.
struct StepOptions : PieceOptions {
  int workpiece = 1;
  std::vector<std::string> patterns{};
  std::string center{};
  std::optional<double> tool_diameter{}, tool_length{}, allowance{}, feed{}, speed{}, tolerance{},
      angle_tolerance{};
  double raise = 0.0;
};

Result<StepTest> test_of(const StepOptions& o) {
  StepTest test;
  const auto workpiece = programs::step_workpiece(o.workpiece);
  if (!workpiece)
    return error("out-of-range"_id, fmt::format("there is no workpiece {}", o.workpiece), "1 or 2");
  test.workpiece = programs::raised(*workpiece, o.raise);
  test.patterns = o.patterns;
  if (o.tool_diameter) test.tool_diameter = {*o.tool_diameter};
  if (o.tool_length) test.tool_length = {*o.tool_length};
  if (o.allowance) test.allowance = {*o.allowance};
  if (o.feed) test.feed = *o.feed;
  if (o.speed) test.spindle_speed = *o.speed;
  if (o.tolerance) test.tolerance = {*o.tolerance / kUmPerMm};
  if (o.angle_tolerance) test.angle_tolerance = {*o.angle_tolerance / kUradPerRad};
  if (!o.center.empty()) {
    const auto center = numbers_of(o.center, 2, "--center");
    if (!center) return center.error();
    test.workpiece.centre_x = (*center)[0];
    test.workpiece.centre_y = (*center)[1];
  }
  return test;
}

Result<std::vector<fs::path>> write_step(const StepOptions& options, const Machine& machine,
                                         const fs::path& machine_file) {
  const auto test = test_of(options);
  if (!test) return test.error();
  const auto made = programs::step_pattern(*test, machine, *parser::dialect_named(options.dialect));
  if (!made) return made.error();
  return programs::write_test_piece(made->piece, name_for_job(machine_file, options.out),
                                    options.out,
                                    report::setup_sheet(sheet_of(*test, *made, machine)));
}

}  // namespace

void add_step(Command& kinds) {
  auto o = std::make_shared<StepOptions>();
  Command step =
      kinds.command("step", "Step machining patterns of Ibaraki et al. for a tilting rotary table");
  add_piece_options(step, *o, "job.toml, step.nc (.ngc, .mpf, .h), step.plan.toml and setup.html");
  step.option("--workpiece", o->workpiece,
              "1: patterns 1-a 1-b 2-a 2-b (default); 2: 3 or 4, 5-a 5-b 6-a 6-b 7");
  step.option("--patterns", o->patterns,
              "Separated by commas (default: all that the workpiece carries together)")
      .separated_by(',');
  step.option("--center", o->center,
              "x,y of the workpiece's centre from the crossing of the rotary axes, X along the "
              "tilt axis, mm (1: 3.941,-96.376; 2: 3.677,-97.15)");
  step.option("--raise", o->raise, "Added to all heights H above the tilt axis, mm (0)");
  step.option("--tool-diameter", o->tool_diameter, "mm (20)");
  step.option("--tool-length", o->tool_length, "Gauge point to tip, mm (150)");
  step.option("--allowance", o->allowance, "Left on every face of the blank, mm (0.5)");
  step.option("--feed", o->feed, "mm/min (1000)");
  step.option("--speed", o->speed, "Spindle, 1/min (5000)");
  step.option("--tolerance", o->tolerance, "Of dL, dH and dL0, um (20)");
  step.option("--angle-tolerance", o->angle_tolerance, "Of theta and phi, urad (100)");
  step.footer(
      "Example: frustum program step --machine zx-yac --patterns 1-a,2-a --workpiece 1 --out step");
  step.runs([o] {
    return write_piece(*o, [&o](const Machine& machine, const fs::path& file) {
      return write_step(*o, machine, file);
    });
  });
}

}  // namespace frustum::app

#include "post/comparing/program_difference.hpp"

#include <utility>

#include "kinematics/controller/controller.hpp"
#include "kinematics/path/travel.hpp"
#include "post/comparing/difference_cause.hpp"
#include "post/comparing/path_difference.hpp"

namespace frustum::post {
namespace {

Result<kinematics::CommandedProgram> commanded(const kinematics::Machine& machine,
                                               const ComparedProgram& program) {
  auto run = kinematics::command(machine, program.setup, program.motions, {.check_travel = false});
  if (run) return run;
  Diagnostics problems = run.error();
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = program.file;
  }
  return problems;
}

kinematics::ToolPath path_of(const kinematics::Machine& machine, const ComparedProgram& program,
                             const kinematics::CommandedProgram& commanded,
                             const DifferenceLimits& limits) {
  // The sampling must not show in the comparison.
  return kinematics::travel(machine, program.setup, commanded, {},
                            {.path_bound = 0.05 * limits.tip, .time_law = {.limits = false}})
      .path;
}

// Some programs leave the retract for a tool change to it, and some call no tool at all.
void complete(ComparedProgram& program) {
  constexpr int kUncalled = -1;  // no program has such a tool
  program.setup.tools[kUncalled] = {};
  parser::HomeReturn up;
  up.axes.at(static_cast<std::size_t>(parser::AxisLetter::Z)) = true;
  std::vector<parser::Motion> motions{{{}, parser::ToolChange{kUncalled}}};
  motions.reserve(program.motions.size() + 1);
  for (parser::Motion& motion : program.motions) {
    if (auto* change = std::get_if<parser::ToolChange>(&motion.command)) {
      if (!change->axes_stay) motions.push_back({motion.place, up});
      if (change->tool == 0) change->tool = kUncalled;
    }
    motions.push_back(std::move(motion));
  }
  program.motions = std::move(motions);
}

}  // namespace

Result<ProgramComparison> compare_programs(const kinematics::Machine& machine,
                                           ComparedProgram first, ComparedProgram second,
                                           const DifferenceLimits& limits) {
  complete(first);
  complete(second);
  const auto first_commanded = commanded(machine, first);
  if (!first_commanded) return first_commanded.error();
  const auto second_commanded = commanded(machine, second);
  if (!second_commanded) return second_commanded.error();
  const kinematics::ToolPath first_path = path_of(machine, first, *first_commanded, limits);
  const kinematics::ToolPath second_path = path_of(machine, second, *second_commanded, limits);
  if (!has_feed(first_path) && !has_feed(second_path)) {
    return error("no-feed-move"_id, "neither program has a feed move: there is nothing to compare",
                 "the tool is fed by G1, G2, G3 and their like");
  }
  const PathDifference found = path_difference(first_path, second_path, limits);
  ProgramComparison comparison{.first = found.first,
                               .largest_tip = found.largest_tip,
                               .largest_axis = found.largest_axis,
                               .largest_time_ratio = found.largest_time_ratio};
  comparison.first.likely_cause =
      likely_cause(machine, first_path, second_path, second, *second_commanded, found, limits);
  return comparison;
}

}  // namespace frustum::post

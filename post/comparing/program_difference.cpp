#include "post/comparing/program_difference.hpp"

#include <utility>

#include "post/comparing/difference_cause.hpp"
#include "post/comparing/path_difference.hpp"

namespace frustum::post {
namespace {

Result<kinematics::ToolPath> path_of(const kinematics::Machine& machine,
                                     const ComparedProgram& program,
                                     const DifferenceLimits& limits) {
  // The sampling must not show in the comparison.
  auto run = kinematics::execute(
      machine, {}, program.setup, program.motions,
      {.path_bound = 0.05 * limits.tip, .check_travel = false, .time_law = {.limits = false}});
  if (run) return std::move(run->path);
  Diagnostics problems = run.error();
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = program.file;
  }
  return problems;
}

}  // namespace

Result<ProgramComparison> compare_programs(const kinematics::Machine& machine,
                                           const ComparedProgram& first,
                                           const ComparedProgram& second,
                                           const DifferenceLimits& limits) {
  const auto first_path = path_of(machine, first, limits);
  if (!first_path) return first_path.error();
  const auto second_path = path_of(machine, second, limits);
  if (!second_path) return second_path.error();
  if (!has_feed(*first_path) && !has_feed(*second_path)) {
    return error("neither program has a feed move: there is nothing to compare",
                 "the tool is fed by G1, G2, G3 and their like");
  }
  const PathDifference found = path_difference(*first_path, *second_path, limits);
  ProgramComparison comparison{.first = found.first,
                               .largest_tip = found.largest_tip,
                               .largest_axis = found.largest_axis,
                               .largest_time_ratio = found.largest_time_ratio};
  comparison.first.likely_cause =
      likely_cause(machine, *first_path, *second_path, second, found, limits);
  return comparison;
}

}  // namespace frustum::post

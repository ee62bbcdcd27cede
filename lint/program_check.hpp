// Holds a program against all checks, in one run of it.
//
// The program is read once for its structure (program_structure.hpp) and run once, past the blocks
// that cannot be run; the motions go through each check and, where there is a machine, through its
// controller. Repeats are counted, so that a program of any size gives a list that a person reads.
//
// Units : as of the checks
// Shape : memory does not grow with the program, but for its labels and subprograms, and a bit for
//         each line that a finding comes from
// Errors: none: what is wrong with the program is a finding
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "lint/finding_list.hpp"
#include "parser/interpreter.hpp"
#include "parser/program.hpp"

namespace frustum::lint {

struct CheckOptions {
  parser::InterpreterOptions run{};              // `watch` and `go_on` are the check's own
  const kinematics::Machine* machine = nullptr;  // null: the checks that need one are left out
  kinematics::Setup setup{};
  // Where the axes are before the program, also as far as that is only assumed.
  parser::AxisTarget home{};
  bool decimal_point_is_known = false;  // else words without a point are findings
  // Of a subprogram alone: what depends on what its callers set is left out.
  bool subprogram = false;
  // Of a check and severity; a baseline has to see all.
  std::size_t most_places = kMostPlaces;
  std::set<Check> disabled{};
  // A loop or jump that comes more often than this is taken for one that never ends.
  std::uint64_t most_turns = 300'000;
  // So many blocks run again, by loops and repeats, before the check ends; a move that is held
  // against a machine counts for several.
  std::uint64_t most_repeats = 1'000'000;
  // What else is looked for in a program that runs to its end: in the stock of a job.
  std::function<std::vector<Finding>()> look_further{};
};

struct CheckReport {
  std::vector<Finding> findings{};
  // Findings of a check beyond those that are listed.
  std::map<Check, std::uint64_t> left_out{};
  std::uint64_t blocks = 0;        // that were run
  std::uint64_t motions = 0;       // that they commanded
  std::set<std::string> opened{};  // files of subprograms that were run

  [[nodiscard]] std::size_t count(Severity severity) const;
  // Lists no more than kMostPlaces of a check and severity, but for what is suppressed.
  void cut_short();
};

[[nodiscard]] CheckReport check_program(const parser::Program& program,
                                        const CheckOptions& options);

}  // namespace frustum::lint

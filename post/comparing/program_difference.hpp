// Whether two NC programs move the tool the same way on one machine, and if not, where they part
// and why.
//
// Model    : both programs are executed on the machine without errors; tip, tool axis and the time
//            that each segment takes are compared along the path
//            (kinematics/path/path_comparison.hpp), and then whether the spindle turns, so that
//            block division, dialect and the way a pose is written play no part. Only feed moves
//            count; travels are not looked at.
//            Z goes home for each tool change in both: machines do so, written or not. Before the
//            first call a tool without length is in the spindle
// Units    : mm, rad, s; frame: table
// Errors   : what the controller refuses in either program, with file and NC line; programs that
//            both have no feed moves
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::post {

struct ComparedProgram {
  std::string file{};  // names it in diagnostics
  std::vector<parser::Motion> motions{};
  kinematics::Setup setup{};
};

struct DifferenceLimits {
  double tip = 2e-3;         // mm
  double axis = 5e-5;        // rad
  double time_ratio = 0.02;  // of the time that a segment takes
};

enum class DifferenceKind : std::uint8_t { none, tip, axis, feed, tool, missing, extra, spindle };

// The first place where the programs part.
struct Difference {
  DifferenceKind kind = DifferenceKind::none;
  std::uint32_t first_line = 0;   // of the block in the first program
  std::uint32_t second_line = 0;  // of the block in the second program
  // Of subprograms that have files of their own; empty: the programs' own files.
  std::string first_file{};
  std::string second_file{};
  double tip = 0.0;            // mm: how far apart the tips are there
  double axis = 0.0;           // rad
  double time_ratio = 1.0;     // second / first, feed differences only
  std::string likely_cause{};  // "rotary axis C has the opposite sign"; empty when none fits
};

struct ProgramComparison {
  Difference first{};        // kind none: the programs agree
  double largest_tip = 0.0;  // over all feed moves
  double largest_axis = 0.0;
  double largest_time_ratio = 1.0;  // the one farthest from 1, as second / first

  [[nodiscard]] bool same() const { return first.kind == DifferenceKind::none; }
};

[[nodiscard]] Result<ProgramComparison> compare_programs(const kinematics::Machine& machine,
                                                         ComparedProgram first,
                                                         ComparedProgram second,
                                                         const DifferenceLimits& limits = {});

}  // namespace frustum::post

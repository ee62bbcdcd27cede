// Where a machine's axes are in each step of a step pattern test, and the blocks that go there.
//
// Units: mm, rad; X Y Z words: the tip from the crossing of the rotary axes in machine directions.
// Errors: StepPlaces::of refuses positions out of travel, all of them at once.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "programs/piece_program.hpp"
#include "programs/step/step_pattern.hpp"
#include "programs/step/tilting_table.hpp"

namespace frustum::programs {

// The number of the one tool.
inline constexpr int kStepTool = 1;

// One step and where it is cut.
struct StepPlace {
  std::string name{};                // "1-a c"
  std::string owner{};               // "pattern 1-a", for messages
  std::string heading{};             // NC comment
  std::vector<std::string> makes{};  // features of the plan
  Vec3 side = Vec3::UnitY();         // machine: from the side edge's surface to the tool axis
  kinematics::AxisPositions rotary{};
  StepCut cut{};
  double clear_z = 0.0;  // word: above the workpiece in this table position
};

struct StepPlaces {
  std::vector<StepPlace> steps{};  // references first
  double safe_z = 0.0;             // word: above the workpiece in every table position

  [[nodiscard]] static Result<StepPlaces> of(const StepTest& test,
                                             std::span<const std::string> patterns,
                                             const kinematics::Machine& machine,
                                             const TiltingTable& table,
                                             const stock::LoftShape& blank,
                                             const Placement& placement);
};

// The program; the cuts get the numbers of their blocks in it.
[[nodiscard]] PieceProgram step_program(const StepTest& test, std::span<const std::string> patterns,
                                        const kinematics::Machine& machine,
                                        const TiltingTable& table, StepPlaces& places);

}  // namespace frustum::programs

// What a machine program is at while it is planned: the program's modes, the axes, the output
// so far.
//
// Units  : mm, rad; frame: table
// Errors : collected in `problems`, with the place of the motion at work: axes that the machine
//          lacks, work offsets and tool lengths that the set-up lacks, positions beyond the travels
#pragma once

#include <string>
#include <vector>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/controller/controller_state.hpp"
#include "post/planning/machine_program.hpp"

namespace frustum::post {

// rad and mm: below any written word; an axis that moves by less is at rest.
inline constexpr double kNoTravel = 1e-12;

[[nodiscard]] inline bool tip_control(const parser::CompensationChange& compensation) {
  return compensation.mode == parser::LengthCompensation::tool_centre_point;
}
[[nodiscard]] kinematics::AxisPositions with_rotary_of(kinematics::AxisPositions q,
                                                       const kinematics::AxisPositions& rotary);

class PlanState {
 public:
  // All must outlive it.
  PlanState(const kinematics::Machine& machine, const kinematics::Setup& setup,
            const PlanOptions& options);

  const kinematics::Machine& machine;
  const kinematics::Setup& setup;
  const PlanOptions& options;
  kinematics::ControllerState controller;  // of the program
  kinematics::AxisPositions q;             // where the axes are
  parser::CompensationChange applied{};    // of the output
  int tool = 0;                            // in the spindle
  bool retracted = false;                  // Z is at its home
  bool moved = false;
  MachineProgram out{};
  Diagnostics problems{};
  parser::SourcePlace place{};  // of the motion at work

  [[nodiscard]] const kinematics::ControllerModes& modes() const { return controller.modes(); }
  [[nodiscard]] bool tip_output() const { return tip_control(applied); }
  // X Y Z words of the program name the tip.
  [[nodiscard]] bool tip_words() const { return modes().tip_control() || modes().plane; }
  [[nodiscard]] double length() const { return controller.tool_length(); }
  // Words of the output under `by`, whose length may be another than the program's: what to take
  // from axis positions, and where the tip is.
  [[nodiscard]] Vec3 axis_shift(const parser::CompensationChange& by) const;
  [[nodiscard]] Vec3 tip_words_at(const kinematics::AxisPositions& q,
                                  const parser::CompensationChange& by) const;
  // Whether these words are the tool's length apart from those without.
  [[nodiscard]] bool length_moves(const parser::AxisTarget& words) const;
  // Travels of X Y Z cannot be checked.
  [[nodiscard]] bool lengths_missing() const { return lengths_missing_; }

  // --- output ---
  void emit(parser::Command command);
  void note(std::string text);
  void compensate(const parser::CompensationChange& wanted);
  // Z to its home, where nothing is in the way.
  void retract();

  // --- checks: false, and the problem is noted ---
  bool present(parser::AxisLetter letter);
  bool known_offset(int number);
  // Axis positions depend on the tool's length, tip coordinates do not. `straight`: the words of a
  // block that is written with them alone.
  bool length_known(const parser::CompensationChange& wanted, const parser::AxisTarget* straight);
  bool within_travel(const kinematics::AxisPositions& q);
  bool way_within_travel(const kinematics::BlockMotion& motion);
  [[nodiscard]] bool rotary_within_travel(const kinematics::AxisPositions& q) const;

  void fail(DiagnosticId id, std::string message, std::string hint);
  void fail(Diagnostic problem);

 private:
  [[nodiscard]] std::vector<std::string> violations(const kinematics::AxisPositions& q) const;
  [[nodiscard]] Diagnostic placed(Diagnostic diagnostic) const;

  bool lengths_missing_ = false;
};

}  // namespace frustum::post

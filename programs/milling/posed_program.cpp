#include "programs/milling/posed_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/model/inverse.hpp"
#include "programs/milling/linearised_axes.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

// Axis-position programs are cut fine enough that straight axis motion stays within this of the
// path.
constexpr double kLineariseTolerance = 2e-6;  // mm

// The rotary axis that leans the tool: not along the tool at home.
std::optional<AxisLetter> tilting_axis(const Machine& machine) {
  for (const kinematics::Joint& joint : machine.joints()) {
    constexpr double kAlong = 0.999;
    if (joint.rotary() && std::abs(joint.direction.z()) < kAlong) return joint.letter;
  }
  return std::nullopt;
}

class PosedProgram {
 public:
  PosedProgram(const PosedProgramSettings& settings, const Machine& machine)
      : settings_(settings),
        machine_(machine),
        axes_(machine.home()),
        nc_(settings.number, settings.title) {}

  Result<TestPiece> write(const std::vector<PathOperation>& operations, TestPiece piece,
                          parser::Dialect dialect) {
    header();
    for (const PathOperation& op : operations) {
      if (auto problem = begin_operation(op)) return *problem;
      for (const auto* moves : {&op.lead_in, &op.cut, &op.lead_out}) {
        const std::uint32_t first = nc_.next_block();
        for (const PathMove& move : *moves) {
          if (auto problem = add_move(move)) return *problem;
        }
        if (moves == &op.cut) {
          piece.operations.push_back({.name = op.name,
                                      .first_line = first,
                                      .last_line = nc_.next_block() - 1,
                                      .makes = op.makes,
                                      .kind = op.kind});
        }
      }
    }
    if (auto problem = beyond_travel()) return *std::move(problem);
    footer();
    const auto written = nc_.write(piece, dialect);
    if (!written) return written.error();
    return piece;
  }

 private:
  void header() {
    for (const std::string& remark : settings_.remarks) nc_.comment(remark);
    nc_.without_compensation();
    nc_.block({parser::ToolChange{kPieceTool}});
    nc_.block(
        {parser::SpindleChange{parser::SpindleDirection::clockwise, settings_.spindle_speed}});
  }

  // Every operation starts from the same place of the rotary axes, so that none inherits turns
  // from the one before.
  std::optional<Diagnostics> begin_operation(const PathOperation& op) {
    nc_.comment(op.name);
    retract();
    AxisPositions start = machine_.home();
    if (settings_.rotary_start) {
      const auto found = start_of(op);
      if (!found) return found.error();
      start = *found;
    }
    parser::AxisTarget rotary;
    add_rotary(rotary, start);
    if (rotary != parser::AxisTarget{}) nc_.block({machine_traverse(rotary)});
    for (const AxisLetter letter : parser::kRotaryAxes) axes_[letter] = start[letter];
    axes_[AxisLetter::Z] = machine_.home()[AxisLetter::Z];
    using enum parser::LengthCompensation;
    switch (settings_.form) {
      case ProgramForm::vector:
        begin_frame(1,
                    {.mode = tool_centre_point, .tool_vectors = true, .offset_number = kPieceTool});
        break;
      case ProgramForm::angles:
        begin_frame(1, {.mode = tool_centre_point, .offset_number = kPieceTool});
        break;
      case ProgramForm::axes:
        nc_.comment("G59 is the machine's own origin: words are axis positions of the tool tip");
        begin_frame(kMachineOffset, {.mode = length, .offset_number = kPieceTool});
        break;
    }
    return std::nullopt;
  }

  void begin_frame(int work_offset, const parser::CompensationChange& compensation) {
    nc_.block({compensation, parser::WorkOffsetChange{work_offset}});
  }

  void retract() {
    nc_.block({parser::CompensationChange{}});
    parser::AxisTarget up;
    up[AxisLetter::Z] = machine_.joint(AxisLetter::Z)->home;
    nc_.block({machine_traverse(up)});
  }

  void footer() {
    retract();
    nc_.block({parser::SpindleChange{}});
    nc_.block({parser::Stop{}});
  }

  [[nodiscard]] kinematics::ToolPose in_table(const PathMove& move) const {
    return {move.pose.tip + settings_.origin, move.pose.axis};
  }

  // Where the tilting axis is at 0 or above; of all such places that nearest to home.
  [[nodiscard]] Result<AxisPositions> start_of(const PathOperation& op) const {
    const PathMove& first = op.lead_in.empty() ? op.cut.front() : op.lead_in.front();
    const AxisPositions home = machine_.home();
    const auto all =
        kinematics::all_solutions(machine_, in_table(first), settings_.tool_length.value, home);
    if (!all) return all.error();
    const auto tilt = tilting_axis(machine_);
    const AxisPositions* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const kinematics::InverseSolution& solution : *all) {
      constexpr double kLevel = 1e-9;    // rad: a tilt of nothing has no sign
      constexpr double kOtherWay = 1e3;  // more than any turns
      double away = tilt && solution.axes[*tilt] < -kLevel ? kOtherWay : 0.0;
      if (!solution.within_travel) away += 10.0 * kOtherWay;
      for (const AxisLetter letter : parser::kRotaryAxes) {
        away += std::abs(solution.axes[letter] - home[letter]);
      }
      if (away >= least) continue;
      least = away;
      best = &solution.axes;
    }
    return best == nullptr ? home : *best;
  }

  std::optional<Diagnostics> add_move(const PathMove& move) {
    const double length = settings_.tool_length.value;
    const auto solutions = kinematics::inverse(machine_, in_table(move), length, axes_);
    if (!solutions) return solutions.error();
    const AxisPositions next = solutions->front().axes;
    if (!solutions->front().within_travel) note_beyond(next);
    if (settings_.form == ProgramForm::vector) {
      add_block(move, tip_target(move.pose.tip), UnitVec3::of(move.pose.axis));
    } else if (settings_.form == ProgramForm::angles) {
      parser::AxisTarget target = tip_target(move.pose.tip);
      add_rotary(target, next);
      add_block(move, target);
    } else {
      for (const AxisPositions& q :
           linearised(machine_, axes_, next, length, kLineariseTolerance)) {
        add_block(move, axis_target(q));
      }
    }
    axes_ = next;
    return std::nullopt;
  }

  // How far each axis would have to go, where it is beyond its travel somewhere.
  void note_beyond(const AxisPositions& q) {
    if (!lowest_) lowest_ = highest_ = q;
    for (const kinematics::Joint& joint : machine_.joints()) {
      (*lowest_)[joint.letter] = std::min((*lowest_)[joint.letter], q[joint.letter]);
      (*highest_)[joint.letter] = std::max((*highest_)[joint.letter], q[joint.letter]);
    }
  }
  [[nodiscard]] std::optional<Diagnostic> beyond_travel() const {
    if (!lowest_) return std::nullopt;
    // Of each end of its travel the place that is farthest beyond that one.
    AxisPositions below = *lowest_, above = *highest_;
    for (const kinematics::Joint& joint : machine_.joints()) {
      below[joint.letter] = std::min(below[joint.letter], joint.travel.hi);
      above[joint.letter] = std::max(above[joint.letter], joint.travel.lo);
    }
    std::vector<std::string> all = kinematics::travel_violations(machine_, below);
    for (std::string& each : kinematics::travel_violations(machine_, above)) {
      all.push_back(std::move(each));
    }
    return error("axis-over-travel"_id,
                 fmt::format("{} does not fit on machine {}, at its farthest: {}", settings_.piece,
                             machine_.name(), fmt::join(all, "; ")),
                 settings_.remedy);
  }

  void add_rotary(parser::AxisTarget& target, const AxisPositions& q) const {
    for (const AxisLetter letter : parser::kRotaryAxes) {
      if (machine_.joint(letter) != nullptr) target[letter] = q[letter];
    }
  }

  // Words of G59 with G43: at rotary zero they are the tip's place in the table frame.
  [[nodiscard]] parser::AxisTarget axis_target(const AxisPositions& q) const {
    const AxisPositions origin =
        kinematics::place_tip(machine_, Vec3::Zero(), settings_.tool_length.value, {});
    parser::AxisTarget target = tip_target({q[AxisLetter::X] - origin[AxisLetter::X],
                                            q[AxisLetter::Y] - origin[AxisLetter::Y],
                                            q[AxisLetter::Z] - origin[AxisLetter::Z]});
    add_rotary(target, q);
    return target;
  }

  void add_block(const PathMove& move, const parser::AxisTarget& end,
                 const std::optional<UnitVec3>& tool_axis = {}) {
    if (move.rapid) {
      nc_.block({parser::Traverse{.end = end, .tool_axis = tool_axis}});
    } else {
      nc_.block({parser::LinearFeed{.end = end, .tool_axis = tool_axis, .feed = {settings_.feed}}});
    }
  }

  const PosedProgramSettings& settings_;
  const Machine& machine_;
  AxisPositions axes_;
  PieceProgram nc_;
  std::optional<AxisPositions> lowest_{}, highest_{};  // of places beyond travel, by axis
};

}  // namespace

Result<TestPiece> write_posed_program(const PosedProgramSettings& settings,
                                      const std::vector<PathOperation>& operations,
                                      const Machine& machine, TestPiece made,
                                      parser::Dialect dialect) {
  return PosedProgram(settings, machine).write(operations, std::move(made), dialect);
}

}  // namespace frustum::programs

#include "post/planning/plan_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/model/inverse.hpp"

namespace frustum::post {

using kinematics::AxisPositions;
using kinematics::kRotaryAxes;
using parser::AxisLetter;
using parser::AxisTarget;
using parser::CompensationChange;

AxisPositions with_rotary_of(AxisPositions q, const AxisPositions& rotary) {
  for (const AxisLetter letter : kRotaryAxes) q[letter] = rotary[letter];
  return q;
}

PlanState::PlanState(const kinematics::Machine& of_machine, const kinematics::Setup& of_setup,
                     const PlanOptions& with_options)
    : machine(of_machine),
      setup(of_setup),
      options(with_options),
      controller(of_machine, of_setup),
      q(of_machine.home()) {}

void PlanState::emit(parser::Command command) {
  out.motions.push_back({place, std::move(command)});
}

void PlanState::note(std::string text) { emit(parser::Event{"comment", std::move(text)}); }

void PlanState::compensate(const CompensationChange& wanted) {
  const bool same = applied.mode == wanted.mode && applied.tool_vectors == wanted.tool_vectors &&
                    applied.offset_number == wanted.offset_number;
  if (same) return;
  applied = wanted;
  emit(wanted);
}

void PlanState::retract() {
  if (retracted) return;
  AxisTarget up;
  up[AxisLetter::Z] = machine.home()[AxisLetter::Z];
  if (tip_output()) compensate({});
  emit(parser::Traverse{up, std::nullopt, parser::Coordinates::machine});
  q[AxisLetter::Z] = *up[AxisLetter::Z];
  retracted = true;
  moved = true;
}

bool PlanState::present(AxisLetter letter) {
  if (machine.joint(letter) != nullptr) return true;
  fail("unknown-axis"_id,
       fmt::format("machine {} ({}) has no axis {}", machine.name(), machine.structure(),
                   parser::to_char(letter)),
       "post-process a program with tool vectors, or choose a machine with that axis");
  return false;
}

bool PlanState::known_offset(int number) {
  if (setup.work_offsets.contains(number)) return true;
  fail("unknown-work-offset"_id, fmt::format("work offset G{} is not defined", 53 + number),
       fmt::format("give its origin in the table frame: G{} under [offsets] of a job, or "
                   "--offset G{}=X,Y,Z",
                   53 + number, 53 + number));
  return false;
}

Vec3 PlanState::axis_shift(const CompensationChange& by) const {
  const double its = controller.length_of(by).value_or(0.0);
  return linear_positions(
      kinematics::place_tip(machine, controller.origin(), its, AxisPositions{}));
}

Vec3 PlanState::tip_words_at(const AxisPositions& at, const CompensationChange& by) const {
  const double its = controller.length_of(by).value_or(0.0);
  return kinematics::nominal_pose(machine, at, its).translation - controller.origin();
}

bool PlanState::length_moves(const parser::AxisTarget& words) const {
  const auto at = [&](double length) {
    return linear_positions(
        kinematics::place_tip(machine, controller.origin(), length, AxisPositions{}));
  };
  const Vec3 along = at(1.0) - at(0.0);
  return std::ranges::any_of(kinematics::kLinearAxes, [&](AxisLetter letter) {
    return words[letter] && std::abs(along[static_cast<Eigen::Index>(letter)]) > kNoTravel;
  });
}

bool PlanState::length_known(const CompensationChange& wanted, const AxisTarget* straight) {
  const CompensationChange& own = modes().compensation;
  const auto missing = [&](const CompensationChange& by) {
    return by.mode != parser::LengthCompensation::off && !setup.tools.contains(by.offset_number);
  };
  // Whose length it is nobody says: of the tool in the spindle, which no program need have called.
  const bool spindle_says =
      tool == 0 && options.zero_is_spindle && options.length == LengthForm::by_number;
  const bool unnamed = modes().compensates() && own.offset_number == 0 && !spindle_says;
  if (!missing(own) && !missing(wanted) && !unnamed) return true;
  if (straight != nullptr && !tip_words() && !tip_control(wanted) && !length_moves(*straight)) {
    return true;
  }
  const int number = missing(own) ? own.offset_number : wanted.offset_number;
  const bool same_length = !unnamed && missing(own) && own.offset_number == wanted.offset_number;
  if (same_length && !own.negative && tip_words() == tip_control(wanted)) {
    if (!lengths_missing_) {
      out.warnings.push_back(placed(warning(
          "unknown-tool-length"_id,
          fmt::format("the length of tool {} is not known: travels of X Y Z are not checked",
                      number),
          fmt::format("give it with --tool-length {}=LENGTH or a job", number))));
    }
    lengths_missing_ = true;
    return true;
  }
  fail(number == 0 ? "tool-length-missing"_id : "unknown-tool-length"_id,
       number == 0 ? std::string("tool length compensation without an H word")
                   : fmt::format("axis positions need the length of tool {}", number),
       number == 0
           ? std::string("call the tool and give its number: T1 M6, G43 H1")
           : fmt::format("give it with --tool-length {}=LENGTH, or a job with --job", number));
  return false;
}

std::vector<std::string> PlanState::violations(const AxisPositions& at) const {
  if (!lengths_missing_) return kinematics::travel_violations(machine, at);
  return kinematics::travel_violations(machine, with_rotary_of(machine.home(), at));
}

bool PlanState::rotary_within_travel(const AxisPositions& at) const {
  return kinematics::travel_violations(machine, with_rotary_of(machine.home(), at)).empty();
}

bool PlanState::within_travel(const AxisPositions& at) {
  const auto found = violations(at);
  if (found.empty()) return true;
  fail("axis-over-travel"_id, fmt::format("over-travel: {}", fmt::join(found, "; ")),
       "move the workpiece on the table, or choose a larger machine");
  return false;
}

bool PlanState::way_within_travel(const kinematics::BlockMotion& motion) {
  const int parts = motion.least_parts();
  for (int i = parts; i > 0; --i) {
    if (!within_travel(motion.at(static_cast<double>(i) / parts))) return false;
  }
  return true;
}

void PlanState::fail(DiagnosticId id, std::string message, std::string hint) {
  fail(error(id, std::move(message), std::move(hint)));
}

void PlanState::fail(Diagnostic problem) { problems.push_back(placed(std::move(problem))); }

Diagnostic PlanState::placed(Diagnostic diagnostic) const {
  if (place.file) diagnostic.file = *place.file;
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return diagnostic;
}

}  // namespace frustum::post

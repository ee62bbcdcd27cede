#include "post/comparing/difference_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "post/comparing/amount_fit.hpp"
#include "post/comparing/fault.hpp"
#include "post/comparing/trial_path.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisState;
using kinematics::Joint;
using kinematics::kRotaryAxes;
using kinematics::Machine;
using kinematics::PathMatch;
using kinematics::ToolPath;

// --- differences in one place -------------------------------------------------------------------

constexpr std::uint32_t kFewBlocks = 3;

std::string unequal_word(const Machine& machine, const AxisState& first, const AxisState& second) {
  const Joint* most = nullptr;
  double largest = 0.0;
  for (const Joint& joint : machine.joints()) {
    const double off = second.q[joint.letter] - first.q[joint.letter];
    const double weighed = std::abs(off) * (joint.rotary() ? kDegPerRad : 1.0);
    if (weighed > largest) {
      largest = weighed;
      most = machine.joint(joint.letter);
    }
  }
  if (most == nullptr) return "only this block differs";
  return fmt::format(
      "only this block differs; axis {} most, by {:.4f} {}", to_char(most->letter),
      (second.q[most->letter] - first.q[most->letter]) * (most->rotary() ? kDegPerRad : 1.0),
      most->rotary() ? "deg" : "mm");
}

// The programs differ in a few blocks only: which word, or a block left out.
std::string local_cause(const Machine& machine, const ToolPath& first, const ToolPath& second,
                        const DifferenceLimits& limits) {
  const auto found = kinematics::match_paths(first, second);
  const auto& matches = found.matches;
  const auto apart = [&](const PathMatch& m) {
    return m.tip_distance() > limits.tip || m.axis_angle() > limits.axis;
  };
  const auto begin = std::find_if(matches.begin(), matches.end(), apart);
  if (begin == matches.end()) return {};
  const auto end = std::find_if(matches.rbegin(), matches.rend(), apart).base();
  const std::uint32_t blocks = std::prev(end)->reference.block - begin->reference.block + 1;
  if (end == matches.end()) {
    // Nothing of the second program is left, and it does not move while the first one goes on.
    const bool ends_early = begin != matches.begin() && found.left_over <= limits.tip &&
                            std::prev(end)->other.block == begin->other.block;
    return ends_early ? "the second program ends here" : std::string();
  }
  if (blocks > kFewBlocks) return {};
  const auto before = begin == matches.begin() ? begin : std::prev(begin);
  const std::uint32_t own = end->reference.block - before->reference.block;
  const std::uint32_t others = end->other.block - before->other.block;
  if (others < own) return "a block of the first program is missing in the second";
  if (others > own) return "only this block differs";
  const auto farthest = std::max_element(begin, end, [](const PathMatch& a, const PathMatch& b) {
    return a.tip_distance() < b.tip_distance();
  });
  return unequal_word(machine, farthest->reference.axes, farthest->other.axes);
}

// --- feeds --------------------------------------------------------------------------------------

std::string feed_cause(double time_ratio) {
  struct Known {
    double ratio;
    const char* words;
  };
  static constexpr std::array kKnown{
      Known{60.0, "the feed is per second where the first program's is per minute"},
      Known{1.0 / 60.0, "the feed is per minute where the first program's is per second"},
      Known{25.4, "the feed is in inches where the first program's is in millimetres"},
      Known{1.0 / 25.4, "the feed is in millimetres where the first program's is in inches"},
  };
  for (const Known& known : kKnown) {
    if (std::abs(time_ratio / known.ratio - 1.0) < 0.02) return known.words;
  }
  return fmt::format("the feed is {:.4g} times that of the first program (feed word or feed mode)",
                     1.0 / time_ratio);
}

// --- faults that are undone ---------------------------------------------------------------------

std::span<const parser::Motion> until_shortly_after(const std::vector<parser::Motion>& motions,
                                                    std::uint32_t line) {
  constexpr std::ptrdiff_t kFurther = 200;  // motions
  const auto there = std::find_if(motions.begin(), motions.end(),
                                  [&](const parser::Motion& m) { return m.place.line >= line; });
  const auto further = std::min(kFurther, motions.end() - there);
  return {motions.begin(), there + further};
}

std::string undone_fault(const Machine& machine, const ToolPath& first,
                         const ComparedProgram& program, std::uint32_t parting_line,
                         std::span<const Fault> faults, const DifferenceLimits& limits) {
  for (const Fault& fault : faults) {
    const auto motions = fault.undo(program.motions);
    // Most faults show where the programs part that they are not it.
    const auto beginning = until_shortly_after(motions, parting_line);
    const auto screened = path_of(machine, program.setup, beginning, PathSampling::coarse, limits);
    if (!screened || !lies_on(*screened, first, limits)) continue;
    const auto path = path_of(machine, program.setup, motions, PathSampling::fine, limits);
    if (path && same_way(first, *path, limits)) return fault.words;
  }
  return {};
}

// Rotary axes that differ by a constant: the difference where the programs begin to feed.
std::vector<Fault> rotary_shifts(const Machine& machine, const ToolPath& first,
                                 const ToolPath& second) {
  std::vector<Fault> shifts;
  const auto matches = kinematics::match_paths(first, second).matches;
  if (matches.empty()) return shifts;
  for (const AxisLetter letter : kRotaryAxes) {
    if (machine.joint(letter) == nullptr) continue;
    const double off =
        matches.front().other.axes.q[letter] - matches.front().reference.axes.q[letter];
    // Written programs round to 1e-6 deg or so; shifts are usually whole degrees.
    constexpr double kWritten = 1e-4;
    const double rounded = std::round(off * kDegPerRad / kWritten) * kWritten * kRadPerDeg;
    if (std::abs(rounded) > 1e-6) shifts.push_back(shifted_rotary_axis(letter, rounded));
  }
  return shifts;
}

}  // namespace

std::string likely_cause(const Machine& machine, const ToolPath& first, const ToolPath& second,
                         const ComparedProgram& second_program,
                         const kinematics::CommandedProgram& second_commanded,
                         const PathDifference& difference, const DifferenceLimits& limits) {
  switch (difference.first.kind) {
    case DifferenceKind::none:
      return {};
    case DifferenceKind::tool:
      return "another tool is in the spindle";
    case DifferenceKind::feed:
      return difference.same_ratio_throughout
                 ? feed_cause(difference.first.time_ratio)
                 : std::string("the feed of this path segment, or a block left out of it");
    case DifferenceKind::missing:
      return "the second program has no feed moves";
    case DifferenceKind::extra:
      return "the second program has feed moves that the first does not have";
    case DifferenceKind::spindle:
      return "the spindle turns in one of the programs only";
    case DifferenceKind::tip:
    case DifferenceKind::axis:
      break;
  }
  const std::uint32_t line = difference.first.second_line;
  if (std::string cause = local_cause(machine, first, second, limits); !cause.empty()) return cause;
  if (std::string cause =
          undone_fault(machine, first, second_program, line, known_faults(machine), limits);
      !cause.empty()) {
    return cause;
  }
  if (std::string cause = undone_fault(machine, first, second_program, line,
                                       rotary_shifts(machine, first, second), limits);
      !cause.empty()) {
    return cause;
  }
  const AmountFit fit(machine, first, second_program, second_commanded, limits);
  for (const Amounts& amounts : adjustable(machine)) {
    if (const auto p = fit(amounts)) return amounts.words(*p);
  }
  return {};
}

}  // namespace frustum::post

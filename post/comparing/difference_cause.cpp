#include "post/comparing/difference_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/linear_algebra.hpp"
#include "post/comparing/fault.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisState;
using kinematics::GeometricErrors;
using kinematics::Joint;
using kinematics::kRotaryAxes;
using kinematics::Machine;
using kinematics::PathKind;
using kinematics::PathMatch;
using kinematics::Setup;
using kinematics::ToolPath;
using kinematics::ToolPose;

// How close the samples of an executed path lie. Coarse ones are exact where they are, with longer
// straight lines between: enough to see that a path goes elsewhere.
enum class Sampling : std::uint8_t { coarse, fine };

std::optional<ToolPath> executed(const Machine& machine, const GeometricErrors& errors,
                                 const Setup& setup, std::span<const parser::Motion> motions,
                                 Sampling sampling, const DifferenceLimits& limits) {
  constexpr double kNoBound = 1e9;  // mm
  const double bound = sampling == Sampling::coarse ? kNoBound : 0.2 * limits.tip;
  auto run = kinematics::execute(
      machine, errors, setup, motions,
      {.path_bound = bound, .check_travel = false, .time_law = {.limits = false}});
  if (!run) return std::nullopt;
  return std::move(run->path);
}

bool lies_on(const ToolPath& path, const ToolPath& first, const DifferenceLimits& limits) {
  const auto matches =
      kinematics::match_paths(path, first, {.stop_beyond = 2.0 * limits.tip}).matches;
  return std::all_of(matches.begin(), matches.end(), [&](const PathMatch& m) {
    return m.tip_distance() <= limits.tip && m.axis_angle() <= limits.axis;
  });
}

bool same_way(const ToolPath& first, const ToolPath& second, const DifferenceLimits& limits) {
  const DifferenceKind kind = path_difference(first, second, limits).first.kind;
  return kind == DifferenceKind::none || kind == DifferenceKind::feed;
}

// --- amounts that are fitted --------------------------------------------------------------------

// What a setup or a machine may have different, by as many amounts as it has parameters.
struct Amounts {
  int count = 0;
  std::function<void(const Eigen::VectorXd&, Setup&, GeometricErrors&)> apply{};
  std::function<std::string(const Eigen::VectorXd&)> words{};
};

void move_offsets(Setup& setup, const Vec3& by) {
  for (auto& [number, offset] : setup.work_offsets) offset += by;
}

void displace(kinematics::AxisErrors& axis, const Vec3& by) {
  for (std::size_t k = 0; k < 3; ++k) axis.location[k] += by[static_cast<Eigen::Index>(k)];
}

// The rotary axis that this one carries.
std::optional<AxisLetter> next_rotary(const Machine& machine, AxisLetter letter) {
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    bool found = false;
    for (const Joint& joint : *chain) {
      if (found && joint.rotary()) return joint.letter;
      found = found || joint.letter == letter;
    }
  }
  return std::nullopt;
}

std::vector<Amounts> adjustable(const Machine& machine) {
  std::vector<Amounts> all;
  all.push_back({1,
                 [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
                   for (auto& [number, tool] : setup.tools) tool.length_error += p[0];
                 },
                 [](const Eigen::VectorXd& p) {
                   return fmt::format("the tool length compensated differs by {:.4f} mm", p[0]);
                 }});
  all.push_back({1,
                 [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
                   for (auto& [number, tool] : setup.tools) tool.length += p[0];
                 },
                 [](const Eigen::VectorXd& p) {
                   return fmt::format(
                       "posted for another pivot or tool length, different by {:.4f} mm", p[0]);
                 }});
  all.push_back(
      {3,
       [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
         move_offsets(setup, p.head<3>());
       },
       [](const Eigen::VectorXd& p) {
         return fmt::format(
             "the program origin (work offset) is displaced by ({:.4f}, {:.4f}, {:.4f}) mm", -p[0],
             -p[1], -p[2]);
       }});
  for (const Joint& axis : machine.joints()) {
    const Joint* joint = machine.joint(axis.letter);
    const auto carried = next_rotary(machine, axis.letter);
    if (!axis.rotary() || (axis.side > 0 && !carried)) continue;
    all.push_back({3,
                   [letter = axis.letter, carried](const Eigen::VectorXd& p, Setup& setup,
                                                   GeometricErrors& errors) {
                     displace(errors[letter], p);
                     // What the axis carries stays where it is.
                     if (carried) {
                       displace(errors[*carried], -p);
                     } else {
                       setup.table_from_workpiece.translation -= p;
                     }
                   },
                   [joint](const Eigen::VectorXd& p) {
                     const Vec3 off = p;
                     const Vec3 across = off - joint->direction * joint->direction.dot(off);
                     return fmt::format(
                         "posted for a rotary axis {} that lies elsewhere (pivot), by "
                         "({:.4f}, {:.4f}, {:.4f}) mm",
                         to_char(joint->letter), across.x(), across.y(), across.z());
                   }});
  }
  return all;
}

// The last pose of every feed block: as many for every setup.
std::vector<ToolPose> block_ends(const ToolPath& path) {
  std::vector<ToolPose> ends;
  for (std::size_t k = 0; k < path.segments.size(); ++k) {
    const auto block = path.segments[k].block;
    const bool last = k + 1 == path.segments.size() || path.segments[k + 1].block != block;
    if (last && path.blocks[block].kind == PathKind::feed)
      ends.push_back(path.to(path.segments[k]));
  }
  return ends;
}

// Tips of `path` at the given shares of its whole length.
class ProgressOf {
 public:
  explicit ProgressOf(const std::vector<ToolPose>& poses) : poses_(poses), way_(poses.size(), 0.0) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
      way_[i] = way_[i - 1] + (poses[i].tip - poses[i - 1].tip).norm() +
                20.0 * (poses[i].axis - poses[i - 1].axis).norm();
    }
  }
  [[nodiscard]] double share(std::size_t i) const { return way_[i] / way_.back(); }
  [[nodiscard]] Vec3 tip_at(double share) const {
    const auto after = std::lower_bound(way_.begin(), way_.end(), share * way_.back());
    const auto i = static_cast<std::size_t>(std::min(after, way_.end() - 1) - way_.begin());
    if (i == 0) return poses_.front().tip;
    const double step = way_[i] - way_[i - 1];
    const double t = step > 0.0 ? (share * way_.back() - way_[i - 1]) / step : 1.0;
    return poses_[i - 1].tip + t * (poses_[i].tip - poses_[i - 1].tip);
  }

 private:
  const std::vector<ToolPose>& poses_;
  std::vector<double> way_;
};

class AmountFit {
 public:
  AmountFit(const Machine& machine, const ToolPath& first, const ComparedProgram& program,
            const DifferenceLimits& limits)
      : machine_(machine), first_(first), program_(program), limits_(limits) {}

  // The amounts that make the program agree with the first path; nothing when none do.
  [[nodiscard]] std::optional<Eigen::VectorXd> operator()(const Amounts& amounts) const {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(amounts.count);
    const auto start = run(amounts, p);
    if (!start) return std::nullopt;
    const std::vector<ToolPose> poses = block_ends(*start);
    if (poses.size() < 2) return std::nullopt;
    const auto slopes = slopes_of(amounts, poses);
    if (!slopes || slopes->norm() < 1e-6) return std::nullopt;

    p = step(*slopes, by_progress(poses));
    // The displacement is linear in the amounts; what changes from step to step is which places of the
    // two paths belong together.
    constexpr int kMostSteps = 8;
    for (int k = 0; k < kMostSteps; ++k) {
      const auto path = run(amounts, p);
      if (!path) return std::nullopt;
      if (lies_on(*path, first_, limits_)) return same_way_with(amounts, p);
      const Eigen::VectorXd further = step_across(*slopes, *path);
      if (further.norm() < 0.01 * limits_.tip) return std::nullopt;  // as good as it gets
      p += further;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<ToolPath> run(const Amounts& amounts, const Eigen::VectorXd& p,
                                            Sampling sampling = Sampling::coarse) const {
    Setup setup = program_.setup;
    GeometricErrors errors;
    amounts.apply(p, setup, errors);
    return executed(machine_, errors, setup, program_.motions, sampling, limits_);
  }

  [[nodiscard]] std::optional<Eigen::VectorXd> same_way_with(const Amounts& amounts,
                                                             const Eigen::VectorXd& p) const {
    const auto path = run(amounts, p, Sampling::fine);
    if (path && same_way(first_, *path, limits_)) return p;
    return std::nullopt;
  }

  // Motion of each block end by a unit of each amount: three rows a block.
  [[nodiscard]] std::optional<Eigen::MatrixXd> slopes_of(const Amounts& amounts,
                                                         const std::vector<ToolPose>& poses) const {
    Eigen::MatrixXd slopes(3 * static_cast<Eigen::Index>(poses.size()), amounts.count);
    for (int k = 0; k < amounts.count; ++k) {
      const auto moved = run(amounts, Eigen::VectorXd::Unit(amounts.count, k));
      if (!moved) return std::nullopt;
      const std::vector<ToolPose> ends = block_ends(*moved);
      if (ends.size() != poses.size()) return std::nullopt;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        slopes.block<3, 1>(3 * static_cast<Eigen::Index>(i), k) = ends[i].tip - poses[i].tip;
      }
    }
    return slopes;
  }

  // How far each block end is from where the first path is after the same share of its way.
  [[nodiscard]] Eigen::VectorXd by_progress(const std::vector<ToolPose>& poses) const {
    const std::vector<ToolPose> reference = block_ends(first_);
    const ProgressOf wanted(reference), own(poses);
    Eigen::VectorXd off(3 * static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      off.segment<3>(3 * static_cast<Eigen::Index>(i)) = wanted.tip_at(own.share(i)) - poses[i].tip;
    }
    return off;
  }

  // Only displacements across the direction of the first path count.
  [[nodiscard]] Eigen::VectorXd step_across(const Eigen::MatrixXd& slopes,
                                            const ToolPath& path) const {
    const std::vector<ToolPose> poses = block_ends(path);
    // After the first step a true cause leaves the paths close together.
    const auto matches = kinematics::match_paths(path, first_, {.most_apart = 0.2}).matches;
    Eigen::MatrixXd across_slopes = slopes;
    Eigen::VectorXd off = Eigen::VectorXd::Zero(slopes.rows());
    std::size_t m = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      while (m + 1 < matches.size() && (matches[m].reference.pose.tip != poses[i].tip)) ++m;
      const Vec3 along = i > 0 ? Vec3(poses[i].tip - poses[i - 1].tip) : Vec3::Zero();
      Mat3 across = Mat3::Identity();
      if (along.norm() > 0.0) across -= along * along.transpose() / along.squaredNorm();
      const auto row = 3 * static_cast<Eigen::Index>(i);
      off.segment<3>(row) = across * (matches[m].other.pose.tip - poses[i].tip);
      across_slopes.middleRows<3>(row) = (across * slopes.middleRows<3>(row)).eval();
    }
    return step(across_slopes, off);
  }

  static Eigen::VectorXd step(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& off) {
    return shortest_solution(slopes, off, 1e-9);  // amounts that change nothing stay zero
  }

  const Machine& machine_;
  const ToolPath& first_;
  const ComparedProgram& program_;
  const DifferenceLimits& limits_;
};

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
    const auto screened = executed(machine, {}, program.setup, beginning, Sampling::coarse, limits);
    if (!screened || !lies_on(*screened, first, limits)) continue;
    const auto path = executed(machine, {}, program.setup, motions, Sampling::fine, limits);
    if (path && same_way(first, *path, limits)) return fault.words;
  }
  return {};
}

// Rotary axes that lie a constant apart: the difference where the programs begin to feed.
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
                         const ComparedProgram& second_program, const PathDifference& difference,
                         const DifferenceLimits& limits) {
  switch (difference.first.kind) {
    case DifferenceKind::none:
      return {};
    case DifferenceKind::tool:
      return "another tool is in the spindle";
    case DifferenceKind::feed:
      return difference.same_ratio_throughout
                 ? feed_cause(difference.first.time_ratio)
                 : std::string("the feed of this stretch, or a block left out of it");
    case DifferenceKind::missing:
      return "the second program has no feed moves";
    case DifferenceKind::extra:
      return "the second program has feed moves that the first does not have";
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
  const AmountFit fit(machine, first, second_program, limits);
  for (const Amounts& amounts : adjustable(machine)) {
    if (const auto p = fit(amounts)) return amounts.words(*p);
  }
  return {};
}

}  // namespace frustum::post

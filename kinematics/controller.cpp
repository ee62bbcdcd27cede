#include "kinematics/controller.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/path_sampling.hpp"

namespace frustum::kinematics {
namespace {

using parser::AxisTarget;
using parser::Coordinates;
using parser::LengthCompensation;
using parser::Motion;

// Rotary motion is cut at least this fine before the bound decides, so that symmetric error shapes
// cannot hide between the check points.
constexpr double kRotaryPart = 5.0 * kRadPerDeg;
constexpr double kLinearPart = 25.0;  // mm, for the same reason

constexpr std::array kLinear{AxisLetter::X, AxisLetter::Y, AxisLetter::Z};
constexpr std::array kRotary{AxisLetter::A, AxisLetter::B, AxisLetter::C};

Vec3 linear_part(const AxisPositions& q) {
  return {q[AxisLetter::X], q[AxisLetter::Y], q[AxisLetter::Z]};
}

// An arc or helix in program coordinates, u in [0, 1]; straight when `turn` is zero.
struct TipCurve {
  Vec3 start = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  double turn = 0.0;  // rad, signed

  [[nodiscard]] Vec3 at(double u) const {
    if (turn == 0.0) return start + u * (end - start);
    const Vec3 along_start = normal * normal.dot(start);
    const Vec3 along_end = normal * normal.dot(end);
    const Vec3 in_plane_center = center - normal * normal.dot(center);
    const Vec3 spoke = start - along_start - in_plane_center;
    const Vec3 end_spoke = end - along_end - in_plane_center;
    // A radius that differs within the parser's tolerance is spread evenly over the arc.
    const double stretch = 1.0 + u * (end_spoke.norm() / spoke.norm() - 1.0);
    return in_plane_center + stretch * (rotation_about(normal, u * turn) * spoke) +
           (1.0 - u) * along_start + u * along_end;
  }
};

TipCurve arc_curve(const parser::ArcFeed& arc, const Vec3& start, const Vec3& end) {
  TipCurve curve{start, end, arc.center, Vec3::UnitZ(), 0.0};
  if (arc.plane == parser::Plane::zx) curve.normal = Vec3::UnitY();
  if (arc.plane == parser::Plane::yz) curve.normal = Vec3::UnitX();
  const auto spoke = [&](const Vec3& p) -> Vec3 {
    const Vec3 r = p - arc.center;
    return r - curve.normal * curve.normal.dot(r);
  };
  const Vec3 a = spoke(start), b = spoke(end);
  const double sign = arc.turns > 0 ? 1.0 : -1.0;
  double angle = sign * std::atan2(curve.normal.dot(a.cross(b)), a.dot(b));
  // Start and end on the same spoke mean a full turn; 1e-9 rad is below any written coordinate.
  if (angle < 1e-9) angle += 2.0 * std::numbers::pi;
  curve.turn = sign * (angle + 2.0 * std::numbers::pi * (std::abs(arc.turns) - 1));
  return curve;
}

}  // namespace

class Controller::State {
 public:
  State(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
        const ControllerOptions& options)
      : machine_(machine),
        errors_(errors),
        setup_(setup),
        options_(options),
        workpiece_from_table_(setup.table_from_workpiece.inverse()),
        q_(machine.home()) {
    execution_.path.bound = options.path_bound;
    execution_.axes.push_back({0, PathKind::rapid, q_});
  }

  bool run(const Motion& motion) {
    if (!problems_.empty()) return false;
    place_ = motion.place;
    std::visit([this](const auto& command) { execute(command); }, motion.command);
    return problems_.empty();
  }

  Result<Execution> finish() {
    if (!problems_.empty()) return problems_;
    return std::move(execution_);
  }

 private:
  // --- commands -------------------------------------------------------------------------------

  void execute(const parser::Traverse& move) {
    go(move.end, move.tool_axis, move.coordinates, PathKind::rapid, 0.0, nullptr);
  }
  void execute(const parser::LinearFeed& move) {
    go(move.end, move.tool_axis, move.coordinates, PathKind::feed, move.feed.value, nullptr);
  }
  void execute(const parser::ArcFeed& move) {
    go(move.end, move.tool_axis, Coordinates::program, PathKind::feed, move.feed.value, &move);
  }
  void execute(const parser::HomeReturn& move) {
    AxisPositions end = q_;
    const AxisPositions home = machine_.home();
    for (const AxisLetter letter : kAxisLetters) {
      if (move.axes[static_cast<std::size_t>(letter)] && present(letter))
        end[letter] = home[letter];
    }
    if (problems_.empty()) move_axes(end, PathKind::rapid, 0.0);
  }
  void execute(const parser::ToolChange& change) {
    if (change.tool != 0 && !setup_.tools.contains(change.tool)) {
      fail(fmt::format("tool T{} is not defined", change.tool),
           fmt::format("add tool.{} to the job; a tool is never replaced by another", change.tool));
      return;
    }
    tool_ = change.tool;
    chain_broken_ = true;
  }
  void execute(const parser::CompensationChange& change) {
    if (change.mode == LengthCompensation::off) {
      compensation_ = change.mode;
      compensated_length_ = 0.0;
      return;
    }
    const auto tool = setup_.tools.find(change.offset_number);
    if (tool == setup_.tools.end()) {
      fail(change.offset_number == 0
               ? std::string("tool length compensation without an H word")
               : fmt::format("H{}: there is no tool length of that number", change.offset_number),
           "H n takes the length of tool n of the job");
      return;
    }
    if (change.offset_number != tool_) {
      warn(fmt::format("H{} takes the length of tool {}, but tool {} is in the spindle",
                       change.offset_number, change.offset_number, tool_));
    }
    compensation_ = change.mode;
    compensated_length_ = tool->second.length;
  }
  void execute(const parser::WorkOffsetChange& change) {
    const auto offset = setup_.work_offsets.find(change.number);
    if (offset == setup_.work_offsets.end()) {
      fail(fmt::format("work offset G{} is not defined", 53 + change.number),
           fmt::format("add G{} to [offsets] of the job", 53 + change.number));
      return;
    }
    offset_ = offset->second;
    offset_known_ = true;
  }
  void execute(const parser::SpindleChange& change) {
    spindle_on_ = change.direction != parser::SpindleDirection::off && change.speed > 0.0;
  }
  void execute(const parser::OrientationPathChange& /*change*/) {}
  void execute(const parser::RotaryPathChange& /*change*/) {}
  void execute(const parser::TiltedPlaneChange& /*change*/) {}
  void execute(const parser::AlignToPlane& /*align*/) {}
  void execute(const parser::Dwell& /*dwell*/) {}
  void execute(const parser::CoolantChange& /*change*/) {}
  void execute(const parser::Stop& stop) {
    if (stop.kind != parser::StopKind::optional_stop) spindle_on_ = false;
  }
  void execute(const parser::Event& /*event*/) {}

  // --- motion ---------------------------------------------------------------------------------

  void go(const AxisTarget& target, const std::optional<UnitVec3>& tool_axis,
          Coordinates coordinates, PathKind kind, double feed, const parser::ArcFeed* arc) {
    for (const AxisLetter letter : kAxisLetters) {
      if (target[letter] && !present(letter)) return;
    }
    if (kind == PathKind::feed && tool_ == 0) {
      fail("feed move without a tool in the spindle", "call a tool first, for example T1 M6");
      return;
    }
    if (coordinates == Coordinates::machine) {
      AxisPositions end = q_;
      for (const AxisLetter letter : kAxisLetters) {
        if (target[letter]) end[letter] = *target[letter];
      }
      move_axes(end, kind, feed);
      return;
    }
    if (!offset_known_) execute(parser::WorkOffsetChange{1});
    if (!problems_.empty()) return;
    if (compensation_ == LengthCompensation::tool_centre_point) {
      move_tip(target, tool_axis, kind, feed, arc);
    } else if (tool_axis) {
      fail("tool vector words I J K without tool-centre-point control",
           "switch it on with G43.5 H or G43.4 H");
    } else {
      move_words(target, kind, feed, arc);
    }
  }

  // Tool-centre-point control: tip as programmed, rotary axes linear.
  void move_tip(const AxisTarget& target, const std::optional<UnitVec3>& tool_axis, PathKind kind,
                double feed, const parser::ArcFeed* arc) {
    const Vec3 start = nominal_pose(machine_, q_, compensated_length_).translation - offset_;
    Vec3 end = start;
    for (const AxisLetter letter : kLinear) {
      if (target[letter]) end[static_cast<Eigen::Index>(letter)] = *target[letter];
    }
    AxisPositions rotary_end = q_;
    if (tool_axis) {
      if (!orient_to(*tool_axis, end, rotary_end)) return;
    } else {
      for (const AxisLetter letter : kRotary) {
        if (target[letter]) rotary_end[letter] = *target[letter];
      }
    }
    const TipCurve curve =
        arc == nullptr ? TipCurve{start, end, {}, {}, 0.0} : arc_curve(*arc, start, end);
    const AxisPositions from = q_;
    travel(
        [this, from, rotary_end, curve](double u) {
          AxisPositions q = from;
          for (const AxisLetter letter : kRotary) {
            q[letter] = from[letter] + u * (rotary_end[letter] - from[letter]);
          }
          return place_tip(machine_, curve.at(u) + offset_, compensated_length_, q);
        },
        kind, feed, curve.turn);
  }

  // Rotary positions for a programmed tool vector: the solution nearest to where the axes are.
  bool orient_to(const UnitVec3& tool_axis, const Vec3& tip, AxisPositions& rotary_end) {
    const auto solutions = inverse(machine_, {tip + offset_, tool_axis}, compensated_length_, q_);
    if (!solutions) {
      fail(solutions.error().front().message, solutions.error().front().hint);
      return false;
    }
    rotary_end = solutions->front().axes;
    return true;
  }

  // Without tool-centre-point control a word is an axis position; all axes move linearly.
  void move_words(const AxisTarget& target, PathKind kind, double feed,
                  const parser::ArcFeed* arc) {
    const Vec3 shift = axis_shift();
    const Vec3 start = linear_part(q_) - shift;
    Vec3 end = start;
    AxisPositions q_end = q_;
    for (const AxisLetter letter : kAxisLetters) {
      if (!target[letter]) continue;
      if (is_rotary(letter)) {
        q_end[letter] = *target[letter];
      } else {
        end[static_cast<Eigen::Index>(letter)] = *target[letter];
      }
    }
    const TipCurve curve =
        arc == nullptr ? TipCurve{start, end, {}, {}, 0.0} : arc_curve(*arc, start, end);
    const AxisPositions from = q_;
    travel(
        [from, q_end, curve, shift](double u) {
          AxisPositions q = from;
          const Vec3 linear = curve.at(u) + shift;
          for (const AxisLetter letter : kLinear)
            q[letter] = linear[static_cast<Eigen::Index>(letter)];
          for (const AxisLetter letter : kRotary) {
            q[letter] = from[letter] + u * (q_end[letter] - from[letter]);
          }
          return q;
        },
        kind, feed, curve.turn);
  }

  void move_axes(const AxisPositions& end, PathKind kind, double feed) {
    const AxisPositions from = q_;
    travel(
        [from, end](double u) {
          AxisPositions q;
          for (const AxisLetter letter : kAxisLetters) {
            q[letter] = from[letter] + u * (end[letter] - from[letter]);
          }
          return q;
        },
        kind, feed, 0.0);
  }

  // What to add to X Y Z words to get axis positions: at rotary zero the tip is where the words say.
  [[nodiscard]] Vec3 axis_shift() const {
    const AxisPositions zero;
    return linear_part(place_tip(machine_, offset_, compensated_length_, zero));
  }

  // Follows commanded(u), u in [0, 1], checks the travels, and samples where the tool really goes.
  void travel(const std::function<AxisPositions(double)>& commanded, PathKind kind, double feed,
              double arc_turn) {
    const AxisPositions start = q_;
    const AxisPositions end = commanded(1.0);
    double rotary_travel = std::abs(arc_turn);
    for (const AxisLetter letter : kRotary) {
      rotary_travel = std::max(rotary_travel, std::abs(end[letter] - start[letter]));
    }
    const double linear_travel = (linear_part(end) - linear_part(start)).norm();
    const int parts =
        1 + static_cast<int>(rotary_travel / kRotaryPart + linear_travel / kLinearPart);
    // The end first: it is what the block says.
    if (!within_travel(end)) return;
    for (int i = 1; i < parts; ++i) {
      if (!within_travel(commanded(static_cast<double>(i) / parts))) return;
    }
    q_ = end;
    execution_.axes.push_back({place_.line, kind, end});
    if (!options_.sample_path || tool_ == 0) return;

    const ToolGeometry& tool = setup_.tools.at(tool_);
    const auto actual = [&](double u) {
      const Pose table_from_tool =
          actual_pose(machine_, errors_, commanded(u), tool.length + tool.length_error);
      const Pose pose = workpiece_from_table_ * table_from_tool;
      return ToolPose{pose.translation, pose.rotation.col(2)};
    };
    ToolPath& path = execution_.path;
    const auto append = [&](double u, const ToolPose& pose) {
      path.poses.push_back(pose);
      path.axes.push_back(commanded(u));
    };
    if (chain_broken_ || path.poses.empty()) append(0.0, actual(0.0));
    chain_broken_ = false;
    const auto first = static_cast<std::uint32_t>(path.poses.size() - 1);
    const SamplingOptions sampling{options_.path_bound, tool.flute_length, parts};
    for (const PathSample& sample : sample_motion(actual, path.poses.back(), sampling)) {
      append(sample.u, sample.pose);
    }
    const auto block = static_cast<std::uint32_t>(path.blocks.size());
    path.blocks.push_back({.source_line = place_.line,
                           .kind = kind,
                           .spindle_on = spindle_on_,
                           .tool = tool_,
                           .feed = feed});
    for (auto i = first; i + 1 < path.poses.size(); ++i) path.stretches.push_back({i, block});
  }

  // --- checks ---------------------------------------------------------------------------------

  bool present(AxisLetter letter) {
    if (machine_.joint(letter) != nullptr) return true;
    fail(fmt::format("machine {} ({}) has no axis {}", machine_.name(), machine_.structure(),
                     to_char(letter)),
         "choose a machine with that axis, or post-process the program for this one");
    return false;
  }

  bool within_travel(const AxisPositions& q) {
    const auto violations = travel_violations(machine_, q);
    if (violations.empty()) return true;
    fail(fmt::format("over-travel: {}", fmt::join(violations, "; ")),
         "move the workpiece on the table, or choose a larger machine");
    return false;
  }

  void fail(std::string message, std::string hint) {
    note(problems_, error(std::move(message), std::move(hint)));
  }
  void warn(std::string message) { note(execution_.warnings, warning(std::move(message))); }
  void note(Diagnostics& list, Diagnostic diagnostic) const {
    diagnostic.line = static_cast<int>(place_.line);
    diagnostic.column = static_cast<int>(place_.column);
    list.push_back(std::move(diagnostic));
  }

  const Machine& machine_;
  const GeometricErrors& errors_;
  const Setup& setup_;
  ControllerOptions options_;
  Pose workpiece_from_table_;

  AxisPositions q_;  // where the axes are
  Vec3 offset_ = Vec3::Zero();
  bool offset_known_ = false;
  LengthCompensation compensation_ = LengthCompensation::off;
  double compensated_length_ = 0.0;
  int tool_ = 0;
  bool spindle_on_ = false;
  bool chain_broken_ = true;  // the next pose does not continue the last one
  parser::SourcePlace place_{};

  Execution execution_;
  Diagnostics problems_;
};

Controller::Controller(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
                       const ControllerOptions& options)
    : state_(std::make_unique<State>(machine, errors, setup, options)) {}
Controller::~Controller() = default;

bool Controller::execute(const parser::Motion& motion) { return state_->run(motion); }
Result<Execution> Controller::finish() && { return state_->finish(); }

Result<Execution> execute(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
                          std::span<const parser::Motion> motions,
                          const ControllerOptions& options) {
  Controller controller(machine, errors, setup, options);
  for (const Motion& motion : motions) {
    if (!controller.execute(motion)) break;
  }
  return std::move(controller).finish();
}

}  // namespace frustum::kinematics

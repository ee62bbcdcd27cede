#include "calibration/compensate/compensation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kinematics/controller/controller.hpp"
#include "kinematics/controller/controller_state.hpp"
#include "kinematics/model/actual_inverse.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/path/path_comparison.hpp"
#include "kinematics/path/travel.hpp"

namespace frustum::calibration {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::AxisState;
using kinematics::GeometricErrors;
using kinematics::kLinearAxes;
using kinematics::kRotaryAxes;
using kinematics::Machine;
using kinematics::PathBlock;
using kinematics::PathKind;
using kinematics::Setup;
using kinematics::ToolPath;
using kinematics::ToolPose;
using parser::Motion;

constexpr double kReach = 20.0;  // mm: what a radian of the tool axis weighs

// What the controller interpolates linearly between two blocks, and what a program writes: tip or
// linear axes, and the rotary axes.
struct Words {
  Vec3 linear = Vec3::Zero();
  AxisPositions rotary{};
};

Words between(const Words& from, const Words& to, double t) {
  Words words{from.linear + t * (to.linear - from.linear), from.rotary};
  for (const AxisLetter letter : kRotaryAxes) {
    words.rotary[letter] += t * (to.rotary[letter] - from.rotary[letter]);
  }
  return words;
}

// The coordinates that words are written in: the programmed frame at one block, without tilted
// planes, which are resolved.
class ProgrammedFrame {
 public:
  ProgrammedFrame(const Machine& machine, const kinematics::ControllerState& state)
      : machine_(&machine),
        tip_words_(state.modes().tip_control()),
        length_(state.tool_length()),
        zero_(tip_words_ ? state.origin() : state.axis_shift()) {}

  [[nodiscard]] Words words_of(const AxisPositions& q) const {
    const Vec3 linear = tip_words_ ? kinematics::nominal_pose(*machine_, q, length_).translation
                                   : kinematics::linear_positions(q);
    return {linear - zero_, q};
  }
  [[nodiscard]] AxisPositions axes_of(const Words& words) const {
    const Vec3 linear = words.linear + zero_;
    if (tip_words_) return kinematics::place_tip(*machine_, linear, length_, words.rotary);
    return kinematics::with_linear_positions(words.rotary, linear);
  }

 private:
  const Machine* machine_;
  bool tip_words_;
  double length_;
  Vec3 zero_;
};

// Walks the program and its executed path together and writes the corrected program.
class Compensator {
 public:
  Compensator(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
              const ToolPath& path, const CompensationOptions& options)
      : machine_(machine),
        errors_(errors),
        setup_(setup),
        path_(path),
        options_(options),
        state_(machine, setup) {
    segment_ends_.reserve(path.blocks.size());
    for (std::size_t k = 0; k < path.segments.size(); ++k) {
      const std::uint32_t block = path.segments[k].block;
      if (block >= segment_ends_.size()) segment_ends_.resize(block + 1, {k, k});
      segment_ends_[block].second = k + 1;
    }
  }

  [[nodiscard]] std::vector<Motion> rewritten(std::span<const Motion> motions) {
    for (const Motion& motion : motions) {
      place_ = motion.place;
      state_.follow(motion.command);
      std::visit([&](const auto& command) { rewrite(motion, command); }, motion.command);
    }
    return std::move(out_);
  }

 private:
  // Modes and what moves no axis.
  template <typename Command>
  void rewrite(const Motion& motion, const Command& /*not a motion*/) {
    out_.push_back(motion);
  }
  void rewrite(const Motion& motion, const parser::CompensationChange& /*change*/) {
    Motion written = motion;
    std::get<parser::CompensationChange>(written.command).tool_vectors = false;
    out_.push_back(std::move(written));
  }
  // Rotary positions are written out, so that these have nothing left to say.
  void rewrite(const Motion& /*motion*/, const parser::OrientationPathChange& /*change*/) {}
  void rewrite(const Motion& /*motion*/, const parser::RotaryPathChange& /*change*/) {}
  void rewrite(const Motion& /*motion*/, const parser::TiltedPlaneChange& /*change*/) {}
  void rewrite(const Motion& motion, const parser::AlignToPlane& /*align*/) {
    replace(motion, parser::Feed{});
  }
  void rewrite(const Motion& motion, const parser::HomeReturn& /*home*/) { keep(motion); }
  void rewrite(const Motion& motion, const parser::Traverse& move) {
    if (move.coordinates == parser::Coordinates::machine) {
      keep(motion);
    } else {
      replace(motion, parser::Feed{});
    }
  }
  void rewrite(const Motion& motion, const parser::LinearFeed& move) {
    if (move.coordinates == parser::Coordinates::machine) {
      keep(motion);
    } else {
      replace(motion, move.feed);
    }
  }
  void rewrite(const Motion& motion, const parser::ArcFeed& move) { replace(motion, move.feed); }
  void rewrite(const Motion& motion, const parser::Probe& /*probe*/) { keep(motion); }

  // Every motion with a tool in the spindle is one block of the path, in the same order.
  void keep(const Motion& motion) {
    out_.push_back(motion);
    if (tool() == 0) return;
    at_ = path_.axes[last_pose(next_block_++)].q;
  }

  void replace(const Motion& motion, const parser::Feed& feed) {
    if (tool() == 0) {
      out_.push_back(motion);
      return;
    }
    const auto block = static_cast<std::uint32_t>(next_block_++);
    const std::uint32_t first = first_pose(block), last = last_pose(block);
    const ProgrammedFrame frame(machine_, state_);
    const Words start = frame.words_of(at_.value_or(path_.axes[first].q));
    const bool rapid = path_.blocks[block].kind == PathKind::rapid;
    pieces_.clear();
    piece_start_ = first;
    if (rapid) {
      pieces_.push_back({last, corrected(frame, last)});
    } else {
      split(frame, first, start, last, corrected(frame, last));
    }
    write(rapid, feed);
    at_ = frame.axes_of(pieces_.back().words);
  }

  struct Piece {
    std::uint32_t pose;
    Words words;
  };

  void split(const ProgrammedFrame& frame, std::uint32_t first, const Words& from,
             std::uint32_t last, const Words& to) {
    if (last - first < 2 || follows(frame, first, from, last, to)) {
      pieces_.push_back({last, to});
      return;
    }
    const std::uint32_t middle = first + (last - first) / 2;
    const Words at_middle = corrected(frame, middle);
    split(frame, first, from, middle, at_middle);
    split(frame, middle, at_middle, last, to);
  }

  // Whether the actual tool, with the controller interpolating between the words, passes the wanted
  // poses on the way.
  [[nodiscard]] bool follows(const ProgrammedFrame& frame, std::uint32_t first, const Words& from,
                             std::uint32_t last, const Words& to) const {
    const ToolPose start = wanted(first), end = wanted(last);
    for (std::uint32_t k = first + 1; k < last; ++k) {
      const ToolPose target = wanted(k);
      const double t = fraction(start, end, target);
      const AxisState at{frame.axes_of(between(from, to, t)), path_.axes[k].heading};
      const ToolPose actual =
          kinematics::tool_pose(kinematics::actual_pose(machine_, errors_, at, tool_length()));
      const Vec3 off = actual.tip - target.tip;
      // Off along the path is only early or late.
      const Vec3 along = end.tip - start.tip;
      const double length = along.norm();
      const Vec3 across =
          length > 0.0 ? Vec3(off - along * (along.dot(off) / (length * length))) : off;
      if (across.norm() > options_.bound) return false;
      const double turned = angle_between(actual.axis, target.axis);
      if (turned > options_.axis_bound && turned > options_.axis_bound + axis_left(k)) return false;
    }
    return true;
  }
  // How far the tool goes, in tip and direction together.
  [[nodiscard]] double distance(std::uint32_t from, std::uint32_t to) const {
    const ToolPose a = wanted(from), b = wanted(to);
    return std::hypot((b.tip - a.tip).norm(), kReach * (b.axis - a.axis).norm());
  }
  // How far from start to end the target is.
  static double fraction(const ToolPose& start, const ToolPose& end, const ToolPose& target) {
    const Vec3 tip = end.tip - start.tip;
    const Vec3 axis = kReach * (end.axis - start.axis);
    const double length2 = tip.squaredNorm() + axis.squaredNorm();
    if (length2 == 0.0) return 1.0;
    const double foot =
        tip.dot(target.tip - start.tip) + axis.dot(kReach * (target.axis - start.axis));
    return std::clamp(foot / length2, 0.0, 1.0);
  }

  // What the correction leaves of the direction at this pose, near the pole.
  [[nodiscard]] double axis_left(std::uint32_t pose) const {
    const AxisPositions q = corrected_axes(pose);
    const AxisState at{q, path_.axes[pose].heading};
    return angle_between(
        kinematics::tool_pose(kinematics::actual_pose(machine_, errors_, at, tool_length())).axis,
        wanted(pose).axis);
  }

  [[nodiscard]] int tool() const { return state_.modes().tool.value_or(0); }
  [[nodiscard]] double tool_length() const { return setup_.tools.at(tool()).length; }
  [[nodiscard]] ToolPose wanted(std::uint32_t pose) const {
    return kinematics::tool_pose(
        kinematics::nominal_pose(machine_, path_.axes[pose].q, tool_length()));
  }
  [[nodiscard]] AxisPositions corrected_axes(std::uint32_t pose) const {
    return kinematics::actual_inverse(machine_, errors_, wanted(pose), tool_length(),
                                      path_.axes[pose]);
  }
  [[nodiscard]] Words corrected(const ProgrammedFrame& frame, std::uint32_t pose) const {
    return frame.words_of(corrected_axes(pose));
  }

  [[nodiscard]] std::uint32_t first_pose(std::size_t block) const {
    return path_.segments[segment_ends_[block].first].first_pose;
  }
  [[nodiscard]] std::uint32_t last_pose(std::size_t block) const {
    return path_.segments[segment_ends_[block].second - 1].first_pose + 1;
  }

  void write(bool rapid, const parser::Feed& feed) {
    double way = 0.0;
    for (std::uint32_t k = piece_start_, i = 0; i < pieces_.size(); k = pieces_[i++].pose) {
      way += distance(k, pieces_[i].pose);
    }
    std::uint32_t before = piece_start_;
    for (const Piece& piece : pieces_) {
      const double share = way > 0.0 ? distance(std::exchange(before, piece.pose), piece.pose) / way
                                     : 1.0 / static_cast<double>(pieces_.size());
      parser::AxisTarget target;
      for (const AxisLetter letter : kLinearAxes) {
        target[letter] = piece.words.linear[static_cast<Eigen::Index>(letter)];
      }
      for (const AxisLetter letter : kRotaryAxes) {
        if (machine_.joint(letter) != nullptr) target[letter] = piece.words.rotary[letter];
      }
      if (rapid) {
        out_.push_back({place_, parser::Traverse{.end = target}});
        continue;
      }
      parser::Feed piece_feed = feed;
      if (feed.mode == parser::FeedMode::inverse_time) piece_feed.value /= share;
      out_.push_back({place_, parser::LinearFeed{.end = target, .feed = piece_feed}});
    }
  }

  const Machine& machine_;
  const GeometricErrors& errors_;
  const Setup& setup_;
  const ToolPath& path_;
  CompensationOptions options_;
  kinematics::ControllerState state_;
  std::vector<std::pair<std::size_t, std::size_t>> segment_ends_;  // of each block
  std::vector<Piece> pieces_;                                      // of the block at work
  std::uint32_t piece_start_ = 0;                                  // pose it starts from
  std::vector<Motion> out_;
  std::size_t next_block_ = 0;
  std::optional<AxisPositions> at_{};  // commanded so far
  parser::SourcePlace place_{};
};

// Where the axes are commanded to, on the machine as it is and as it should be.
PathError without_correction(const Machine& machine, const Setup& setup, const ToolPath& actual) {
  const Pose workpiece_from_table = setup.table_from_workpiece.inverse();
  PathError error;
  for (const kinematics::PathSegment& segment : actual.segments) {
    const PathBlock& block = actual.blocks[segment.block];
    if (block.kind != PathKind::feed) continue;
    const std::uint32_t end = segment.first_pose + 1;
    const kinematics::ToolGeometry& tool = setup.tools.at(block.tool);
    const ToolPose wanted = kinematics::tool_pose(
        workpiece_from_table *
        kinematics::nominal_pose(machine, actual.axes[end].q, tool.length + tool.length_error));
    error.tip = std::max(error.tip, (actual.poses[end].tip - wanted.tip).norm());
    error.axis = std::max(error.axis, angle_between(actual.poses[end].axis, wanted.axis));
  }
  return error;
}

// Beside the nominal path: being early or late on it is no error.
PathError beside(const ToolPath& nominal, const ToolPath& actual) {
  PathError error;
  for (const auto& match : kinematics::match_paths(nominal, actual).matches) {
    error.tip = std::max(error.tip, match.tip_distance());
    error.axis = std::max(error.axis, match.axis_angle());
  }
  return error;
}

}  // namespace

Result<CompensatedProgram> compensated(const Machine& machine, const GeometricErrors& errors,
                                       const Setup& setup, std::span<const Motion> motions,
                                       const CompensationOptions& options) {
  const auto commanded = kinematics::command(machine, setup, motions);
  if (!commanded) return commanded.error();
  return compensated(machine, errors, setup, motions, *commanded, options);
}

Result<CompensatedProgram> compensated(const Machine& machine, const GeometricErrors& errors,
                                       const Setup& setup, std::span<const Motion> motions,
                                       const kinematics::CommandedProgram& commanded,
                                       const CompensationOptions& options) {
  const kinematics::TravelOptions sampling{.path_bound = 0.5 * options.bound};
  const ToolPath nominal = kinematics::travel(machine, setup, commanded, {}, sampling).path;
  const ToolPath actual = kinematics::travel(machine, setup, commanded, errors, sampling).path;

  CompensatedProgram result;
  result.motions = Compensator(machine, errors, setup, actual, options).rewritten(motions);
  const auto corrected = kinematics::command(machine, setup, result.motions);
  if (!corrected) return corrected.error();
  const ToolPath proof = kinematics::travel(machine, setup, *corrected, errors, sampling).path;
  result.before = without_correction(machine, setup, actual);
  result.after = beside(nominal, proof);
  return result;
}

}  // namespace frustum::calibration

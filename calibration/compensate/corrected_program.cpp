#include "calibration/compensate/corrected_program.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "calibration/compensate/pose_distance.hpp"
#include "calibration/compensate/stroke.hpp"
#include "kinematics/controller/controller.hpp"
#include "kinematics/controller/controller_state.hpp"

namespace frustum::calibration {
namespace {

using kinematics::AxisLetter;
using kinematics::CommandedMove;
using kinematics::CommandedStep;
using kinematics::GeometricErrors;
using kinematics::kLinearAxes;
using kinematics::kRotaryAxes;
using kinematics::Machine;
using kinematics::PathKind;
using kinematics::Setup;
using parser::Motion;

// mm of the way: a stroke in which an axis turns is not divided further.
constexpr double kShortest = 1e-3;

// Walks the program and what is commanded for it together and writes the corrected program.
class Compensator {
 public:
  Compensator(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
              const kinematics::CommandedProgram& commanded, const CompensationOptions& options,
              const PathShift& shift)
      : machine_(machine),
        errors_(errors),
        setup_(setup),
        options_(options),
        shift_(shift),
        state_(machine, setup),
        controller_(machine, setup, [this](CommandedStep&& step) { follow(step); }) {
    for (const CommandedStep& step : commanded.steps) {
      const auto* move = std::get_if<CommandedMove>(&step);
      if (move != nullptr && move->tool != 0) moves_.push_back(move);
    }
    at_.q = commanded.start;
    at_.tracker = kinematics::ApproachTracker(errors);
  }

  [[nodiscard]] Result<CorrectedProgram> rewritten(std::span<const Motion> motions) {
    for (const Motion& motion : motions) {
      place_ = motion.place;
      state_.follow(motion.command);
      std::visit([&](const auto& command) { rewrite(motion, command); }, motion.command);
      if (!problems_.empty()) return problems_;
    }
    return std::move(out_);
  }

 private:
  // What is written has been commanded: where the axes are, and the direction they came from.
  void follow(const CommandedStep& step) {
    const auto* move = std::get_if<CommandedMove>(&step);
    if (move == nullptr) return;
    const auto& motion = move->motion;
    (void)at_.tracker.follow([&motion](double u) { return motion.at(u); }, motion.least_parts());
    at_.q = motion.end();
    if (move->tool != 0) ++made_;
  }
  void write(const Motion& motion) {
    if (!problems_.empty()) return;
    problems_ = controller_.command(motion);
    out_.motions.push_back(motion);
  }

  // Modes and what moves no axis.
  template <typename Command>
  void rewrite(const Motion& motion, const Command& /*not a motion*/) {
    keep(motion);
  }
  void rewrite(const Motion& motion, const parser::CompensationChange& /*change*/) {
    Motion written = motion;
    std::get<parser::CompensationChange>(written.command).tool_vectors = false;
    keep(written);
  }
  // Rotary positions are written out, so that these have nothing left to say.
  void rewrite(const Motion& /*motion*/, const parser::OrientationPathChange& /*change*/) {}
  void rewrite(const Motion& /*motion*/, const parser::RotaryPathChange& /*change*/) {}
  void rewrite(const Motion& /*motion*/, const parser::TiltedPlaneChange& /*change*/) {}
  void rewrite(const Motion& motion, const parser::AlignToPlane& /*align*/) {
    replace(motion, parser::Feed{});
  }
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

  // Every motion with a tool in the spindle is a block of the path, in the same order.
  void keep(const Motion& motion) {
    made_ = 0;
    write(motion);
    for (; made_ > 0; --made_) out_.sources.push_back({.block = next_block_++});
    at_.corrected_for = at_.tracker.heading();
  }

  void replace(const Motion& motion, const parser::Feed& feed) {
    if (tool() == 0) {
      keep(motion);
      return;
    }
    const CommandedMove& move = *moves_[next_block_];
    const kinematics::ToolGeometry& geometry = setup_.tools.at(tool());
    const WantedBlock wanted(machine_, errors_, move.motion, geometry.length, geometry.flute_length,
                             0.5 * options_.bound,
                             [this](const kinematics::ToolPose& pose, double u) {
                               return shift_.before(pose, next_block_, u);
                             });
    const ProgrammedFrame frame(machine_, state_);
    const StrokeSolver solver(machine_, errors_, frame, wanted);
    if (move.kind == PathKind::rapid) {
      write(solver.solve(at_, 0.0, 1.0, false), {}, wanted);
    } else {
      split(solver, wanted, feed, 0.0, 1.0);
    }
    ++next_block_;
  }

  void split(const StrokeSolver& solver, const WantedBlock& wanted, const parser::Feed& feed,
             double from, double to) {
    if (!problems_.empty()) return;
    const Stroke stroke = solver.solve(at_, from, to, true);
    if (const auto cut = cut_of(solver, wanted, stroke)) {
      split(solver, wanted, feed, from, *cut);
      split(solver, wanted, feed, *cut, to);
    } else {
      write(stroke, feed, wanted);
    }
  }

  // Where a stroke has to be divided.
  [[nodiscard]] std::optional<double> cut_of(const StrokeSolver& solver, const WantedBlock& wanted,
                                             const Stroke& stroke) const {
    const auto inside = wanted.samples_between(stroke.from, stroke.to);
    if (inside.empty() && !stroke.turns) return std::nullopt;
    const double way = distance(wanted.pose(stroke.from), wanted.pose(stroke.to));
    if (inside.empty() && way <= kShortest) return std::nullopt;
    if (stroke.jumps_at) {
      const double t = *stroke.jumps_at;
      if (t * way > 0.5 * kShortest && (1.0 - t) * way > 0.5 * kShortest) {
        return stroke.from + t * (stroke.to - stroke.from);
      }
    }
    if (stroke.settled && solver.follows(stroke, options_.bound, options_.axis_bound)) {
      return std::nullopt;
    }
    return inside.empty() ? 0.5 * (stroke.from + stroke.to) : inside[inside.size() / 2];
  }

  void write(const Stroke& stroke, const std::optional<parser::Feed>& feed,
             const WantedBlock& wanted) {
    Words before = stroke.start;
    for (const Words& words : stroke.turn) {
      // What it takes at the feed of the block.
      const double length = (words.linear - std::exchange(before, words).linear).norm();
      write(words, feed, wanted.way() > 0.0 ? length / wanted.way() : 0.0,
            {next_block_, stroke.from, stroke.from, true});
    }
    const double way = distance(wanted.pose(stroke.from), wanted.pose(stroke.to));
    write(stroke.end, feed, wanted.way() > 0.0 ? way / wanted.way() : stroke.to - stroke.from,
          {next_block_, stroke.from, stroke.to});
    at_.corrected_for = stroke.corrected_for;
  }

  // `share`: of the time of its block.
  void write(const Words& words, const std::optional<parser::Feed>& feed, double share,
             const SourceSpan& source) {
    // A ten-thousandth: no shorter time is of use to a control.
    constexpr double kLeastShare = 1e-4;
    parser::AxisTarget target;
    for (const AxisLetter letter : kLinearAxes) {
      target[letter] = words.linear[static_cast<Eigen::Index>(letter)];
    }
    for (const AxisLetter letter : kRotaryAxes) {
      if (machine_.joint(letter) != nullptr) target[letter] = words.rotary[letter];
    }
    made_ = 0;
    if (!feed) {
      write({place_, parser::Traverse{.end = target}});
    } else {
      parser::Feed written = *feed;
      if (written.mode == parser::FeedMode::inverse_time) {
        written.value /= std::max(share, kLeastShare);
      }
      write({place_, parser::LinearFeed{.end = target, .feed = written}});
    }
    if (made_ > 0) out_.sources.push_back(source);
  }

  [[nodiscard]] int tool() const { return state_.modes().tool.value_or(0); }

  const Machine& machine_;
  const GeometricErrors& errors_;
  const Setup& setup_;
  CompensationOptions options_;
  const PathShift& shift_;
  kinematics::ControllerState state_;
  kinematics::Controller controller_;
  std::vector<const CommandedMove*> moves_{};  // of the program as it was, with a tool
  std::uint32_t next_block_ = 0;               // of them
  CorrectedPlace at_{};                        // of what has been written
  std::size_t made_ = 0;                       // moves with a tool, since it was set to 0
  CorrectedProgram out_{};
  Diagnostics problems_{};
  parser::SourcePlace place_{};
};

}  // namespace

Result<CorrectedProgram> corrected_program(const Machine& machine, const GeometricErrors& errors,
                                           const Setup& setup, std::span<const Motion> motions,
                                           const kinematics::CommandedProgram& commanded,
                                           const CompensationOptions& options,
                                           const PathShift& shift) {
  return Compensator(machine, errors, setup, commanded, options, shift).rewritten(motions);
}

}  // namespace frustum::calibration

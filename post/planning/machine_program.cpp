#include "post/planning/machine_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "post/planning/block_feed.hpp"
#include "post/planning/block_output.hpp"
#include "post/planning/fitting_form.hpp"
#include "post/planning/path_tolerance.hpp"
#include "post/planning/plan_state.hpp"
#include "post/planning/rotary_choice.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisPositions;
using kinematics::BlockMotion;
using kinematics::kRotaryAxes;
using kinematics::linear_positions;
using kinematics::Machine;
using kinematics::ToolPose;
using parser::AxisLetter;
using parser::AxisTarget;
using parser::CompensationChange;
using parser::Coordinates;
using parser::Feed;
using parser::LengthCompensation;
using parser::Motion;

constexpr int kDeepest = 18;  // 262,144 points a block

// Follows the program block by block, as the machine's controller would, and writes each in the
// form asked for.
class Planner {
 public:
  Planner(const Machine& machine, const kinematics::Setup& setup, std::span<const Motion> motions,
          const PlanOptions& options)
      : program_(motions),
        options_(with_fitting_form(machine, motions, options)),
        state_(machine, setup, options_) {}

  Result<MachineProgram> plan() {
    for (at_ = 0; at_ < program_.size() && state_.problems.empty(); ++at_) {
      state_.place = program_[at_].place;
      std::visit([this](const auto& command) { follow(command); }, program_[at_].command);
      if (ended_) break;
    }
    if (!ended_ && state_.problems.empty()) follow(parser::Stop{});
    if (!state_.problems.empty()) return state_.problems;
    return std::move(state_.out);
  }

 private:
  // --- what the program says -------------------------------------------------------------------

  void follow(const parser::Traverse& move) {
    if (move.coordinates == Coordinates::machine) {
      move_axes(move.end, nullptr);
    } else {
      go({move.end, move.tool_axis, nullptr, nullptr});
    }
  }
  void follow(const parser::LinearFeed& move) {
    if (move.coordinates == Coordinates::machine) {
      move_axes(move.end, &move.feed);
    } else {
      go({move.end, move.tool_axis, &move.feed, nullptr});
    }
  }
  void follow(const parser::ArcFeed& move) { go({move.end, move.tool_axis, &move.feed, &move}); }
  void follow(const parser::Probe& /*probe*/) {
    state_.fail("probe-not-posted"_id,
                "a probing move is not post-processed: what follows depends on what it meets",
                "leave the blocks that probe out, and give their results as numbers");
  }
  // Not every dialect has a word for home; its place is known here.
  void follow(const parser::HomeReturn& home) {
    if (home.point != 1) {
      state_.fail("unknown-reference-point"_id,
                  fmt::format("G30: the machine has no reference point {}", home.point),
                  "store the point with G30.1 before, or give it in machine coordinates (G53)");
      return;
    }
    AxisTarget end;
    // G28 alone: those that there are.
    const bool all = std::ranges::all_of(home.axes, std::identity{});
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (!home.axes.at(static_cast<std::size_t>(letter))) continue;
      if (all ? state_.machine.joint(letter) != nullptr : state_.present(letter)) {
        end[letter] = state_.machine.home()[letter];
      }
    }
    if (state_.problems.empty()) move_axes(end, nullptr);
  }
  void follow(const parser::ToolChange& change) {
    stop_spindle();
    if (!change.axes_stay) stays_at_.reset();
    if (change.axes_stay && !stays_at_) stays_at_ = state_.q[AxisLetter::Z];
    state_.retract();
    state_.compensate({});
    state_.tool = change.tool;
    state_.emit(change);
  }
  void follow(const parser::CompensationChange& change) {
    if (change.length) {
      state_.fail("tool-length-programmed"_id, "a program that sets its tool lengths itself",
                  "take the lengths from the job: leave out G43.1, G43.2 and G10 L1, L10, L11");
      return;
    }
    state_.controller.follow(change);
  }
  void follow(const parser::WorkOffsetChange& change) {
    if (!state_.known_offset(change.number)) return;
    state_.controller.follow(change);
    state_.emit(change);
  }
  void follow(const parser::WorkOffsetSetting& setting) {
    state_.fail(
        "work-offset-programmed"_id,
        fmt::format("a program that places {} itself", parser::work_offset_name(setting.number)),
        "leave out G10 and give its origin in the table frame: [offsets] of a job, or "
        "--offset");
  }
  void follow(const parser::OrientationPathChange& change) {
    state_.controller.follow(change);
    if (state_.options.great_circle) state_.emit(change);
  }
  void follow(const parser::RotaryPathChange& change) { state_.controller.follow(change); }
  void follow(const parser::TiltedPlaneChange& change) { state_.controller.follow(change); }
  void follow(const parser::AlignToPlane& /*align*/) {
    const auto& plane = state_.modes().plane;
    if (!plane) {
      state_.fail("no-tilted-plane"_id, "alignment to a tilted plane, but there is none",
                  "define the plane before");
      return;
    }
    if (state_.modes().tip_control()) {  // the tip stays on the work
      go({.tool_axis = UnitVec3::z()});
      return;
    }
    const auto aligned =
        kinematics::nearest_orientation(state_.machine, state_.q, plane->rotation.col(2));
    if (!aligned) {
      state_.fail(aligned.error().front());
      return;
    }
    AxisTarget end;
    for (const AxisLetter letter : kRotaryAxes) {
      if (state_.machine.joint(letter) != nullptr) end[letter] = (*aligned)[letter];
    }
    move_axes(end, nullptr);
  }
  void follow(const parser::SpindleChange& change) {
    state_.controller.follow(change);
    state_.emit(change);
  }
  void follow(const parser::CoolantChange& change) {
    flood_ = change.flood;
    state_.emit(change);
  }
  void follow(const parser::Dwell& dwell) { state_.emit(dwell); }
  void follow(const parser::Event& event) { state_.emit(event); }
  void follow(const parser::Stop& stop) {
    if (stop.kind == parser::StopKind::program_end) {
      state_.retract();
      state_.compensate({});
      stop_spindle();
      if (flood_) follow(parser::CoolantChange{false});
      ended_ = true;
    }
    state_.emit(stop);
  }
  void stop_spindle() {
    const parser::SpindleChange spindle = state_.modes().spindle;
    if (spindle.direction == parser::SpindleDirection::off) return;
    follow(parser::SpindleChange{parser::SpindleDirection::off, spindle.speed});
  }

  // --- motion -----------------------------------------------------------------------------------

  // Machine coordinates: axis positions in every form of output.
  void move_axes(const AxisTarget& end, const Feed* feed) {
    if (feed != nullptr) lower();
    AxisPositions to = state_.q;
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (!end[letter]) continue;
      if (!state_.present(letter)) return;
      to[letter] = *end[letter];
      if (parser::is_rotary(letter)) rotary_.set(letter, to[letter]);
    }
    if (!state_.within_travel(to) || !has_feed(feed)) return;
    if (!state_.modes().compensates() || state_.tip_output()) state_.compensate({});
    if (feed == nullptr) {
      state_.emit(parser::Traverse{end, std::nullopt, Coordinates::machine});
    } else {
      state_.emit(parser::LinearFeed{end, std::nullopt, Coordinates::machine, *feed});
    }
    state_.q = to;
    state_.moved = true;
    const auto& z = end[AxisLetter::Z];
    if (z) stays_at_.reset();
    if (z) state_.retracted = *z >= state_.machine.home()[AxisLetter::Z] - kNoTravel;
  }

  // Z is at its home after a tool change, whatever the program's control does with it. A rapid in X
  // and Y alone is made up there; where its control keeps Z, that follows before the tool is fed.
  void go(const PlannedBlock& block) {
    PlannedBlock beside = block;
    beside.end[AxisLetter::Z].reset();
    const bool by_axes = block.feed == nullptr && !state_.tip_words();
    if (by_axes && state_.retracted && !leaves_height(block.end) && moves(beside.end)) {
      const double up = state_.q[AxisLetter::Z];
      go_there(beside, true);
      state_.retracted = state_.q[AxisLetter::Z] == up;
      return;
    }
    if (!by_axes) lower();
    stays_at_.reset();
    if (state_.problems.empty()) go_there(block);
  }

  // Whether a word says another Z than the program has.
  [[nodiscard]] bool leaves_height(const AxisTarget& end) const {
    const std::optional<double>& z = end[AxisLetter::Z];
    if (!z) return false;
    const double at = stays_at_.value_or(state_.q[AxisLetter::Z]);
    return std::abs(*z + state_.controller.axis_shift().z() - at) > kNoTravel;
  }

  // To where the program has Z, by rapid.
  void lower() {
    const auto z = std::exchange(stays_at_, std::nullopt);
    if (!z || std::abs(*z - state_.q[AxisLetter::Z]) <= kNoTravel) return;
    AxisPositions to = state_.q;
    to[AxisLetter::Z] = *z;
    PlannedBlock down;
    down.end[AxisLetter::Z] = 0.0;
    for (const auto& joint : state_.machine.joints()) {
      if (state_.tip_words()) down.end[joint.letter] = 0.0;
    }
    const CompensationChange wanted = output_compensation();
    if (!state_.within_travel(to) || !state_.length_known(wanted, &down.end)) return;
    state_.compensate(wanted);
    output_.write({down, kinematics::axes_motion(state_.q, to)}, to, {});
  }

  // Whether these words move an axis.
  [[nodiscard]] bool moves(const AxisTarget& end) const {
    const Vec3 words = linear_positions(state_.q) - state_.controller.axis_shift();
    return std::ranges::any_of(parser::kAxisLetters, [&](AxisLetter letter) {
      if (!end[letter]) return false;
      const double at =
          parser::is_rotary(letter) ? state_.q[letter] : words[static_cast<Eigen::Index>(letter)];
      return std::abs(*end[letter] - at) > kNoTravel;
    });
  }

  // `beside`: a rapid that leaves Z where it is.
  void go_there(const PlannedBlock& block, bool beside = false) {
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (block.end[letter] && !state_.present(letter)) return;
    }
    if (!state_.known_offset(state_.modes().work_offset)) return;
    if (!state_.moved) state_.retract();
    const bool tip_words = state_.tip_words();
    if (!tip_words && block.tool_axis) {
      state_.fail("vector-without-tip-control"_id, "tool vector without tool-centre-point control",
                  "switch it on before");
      return;
    }
    const CompensationChange wanted =
        beside && needs_no_length(block.end) ? state_.applied : output_compensation();
    if (!state_.length_known(wanted, block.arc == nullptr ? &block.end : nullptr)) return;
    if (tip_words) {
      move_tip(block, wanted);
    } else {
      move_words(block, wanted);
    }
  }

  // Nor may it be on where it is that of another tool, whose place some controls go to at once.
  [[nodiscard]] bool needs_no_length(const AxisTarget& end) const {
    return state_.options.length != LengthForm::always_by_tool && !tip_control(state_.applied) &&
           state_.options.output == OutputForm::axes && !state_.length_moves(end);
  }

  // What the output needs switched on for a block under the program's own compensation.
  [[nodiscard]] CompensationChange output_compensation() const {
    const LengthForm form = state_.options.length;
    const bool by_tool = form != LengthForm::by_number;
    if (by_tool && state_.tool == 0) return {};  // an empty spindle has no length
    if (!state_.modes().compensates()) {
      if (form != LengthForm::always_by_tool) return {};
      return {.mode = LengthCompensation::length, .offset_number = state_.tool};
    }
    CompensationChange wanted = state_.modes().compensation;
    wanted.negative = false;  // every control adds; the words are written for that
    wanted.mode = state_.options.output == OutputForm::axes ? LengthCompensation::length
                                                            : LengthCompensation::tool_centre_point;
    wanted.tool_vectors = state_.options.output == OutputForm::vectors;
    if (by_tool) wanted.offset_number = state_.tool;
    return wanted;
  }

  void move_tip(const PlannedBlock& block, const CompensationChange& wanted) {
    const Pose& table_from_words = state_.controller.table_from_words();
    const Vec3 start = state_.controller.tip_in_words(state_.q);
    const Vec3 end = with_words(start, block.end);
    const auto image = [&] {
      return output_.arc_image(block, wanted, table_from_words.rotation, start);
    };
    if (state_.modes().orientation_path == parser::OrientationPath::great_circle) {
      const auto motion = great_circle(block, start, end);
      if (!motion) {
        state_.fail(motion.error().front());
        return;
      }
      rotary_.follow_vector(motion->end());
      write_block(block, *motion, wanted, tip_control(wanted) && state_.options.great_circle,
                  image);
      return;
    }
    const auto rotary = rotary_.choose(block, table_from_words.point(end), program_.subspan(at_));
    if (!rotary) return;
    if (rotary->unwind) rewind(rotary->resume, wanted, block.feed != nullptr);
    if (!state_.problems.empty()) return;
    const BlockMotion motion =
        kinematics::tip_motion(state_.machine, state_.q, rotary->axes, curve_of(block, start, end),
                               state_.controller.tip_frame());
    write_block(block, motion, wanted, tip_control(wanted), image);
  }

  // The way decides where the rotary axes end: on the solution that they are on, but for the pole.
  [[nodiscard]] Result<BlockMotion> great_circle(const PlannedBlock& block, const Vec3& start,
                                                 const Vec3& end) const {
    AxisPositions written = state_.q;
    for (const AxisLetter letter : kRotaryAxes) {
      if (block.end[letter]) written[letter] = *block.end[letter];
    }
    const Vec3 axis =
        block.tool_axis
            ? state_.controller.table_from_words().direction(*block.tool_axis)
            : Vec3(kinematics::nominal_pose(state_.machine, written, 0.0).rotation.col(2));
    return kinematics::vector_motion(state_.machine, state_.q, axis, curve_of(block, start, end),
                                     state_.controller.tip_frame());
  }

  void move_words(const PlannedBlock& block, const CompensationChange& wanted) {
    const Vec3 shift = state_.controller.axis_shift();
    const Vec3 start = linear_positions(state_.q) - shift;
    const Vec3 end = with_words(start, block.end);
    const BlockMotion motion = kinematics::words_motion(state_.q, rotary_.as_words(block),
                                                        curve_of(block, start, end), shift);
    write_block(block, motion, wanted, !tip_control(wanted), [&] {
      return output_.arc_image(block, wanted,
                               kinematics::linear_axis_directions(state_.machine, state_.q), start);
    });
  }

  // One block, or as many as it takes. `followed`: the reader follows a straight block as it is.
  template <typename Image>
  void write_block(const PlannedBlock& block, const BlockMotion& motion,
                   const CompensationChange& wanted, bool followed, const Image& image) {
    if (!state_.way_within_travel(motion)) return;
    state_.compensate(wanted);
    const double minutes = minutes_for(block, motion);
    if (!state_.problems.empty()) return;
    const BlockPart whole{block, motion, 0.0, 1.0, minutes};
    if (block.arc != nullptr) {
      if (const auto arc = image()) {
        output_.write(whole, motion.end(), arc);
        return;
      }
    } else if (followed) {
      output_.write(whole, motion.end(), {});
      return;
    }
    split(whole, motion.end(), 0);
  }

  // None is a rapid's.
  bool has_feed(const Feed* feed) {
    if (feed == nullptr || feed->value > 0.0) return true;
    state_.fail("feed-missing"_id, "a cutting move before the first F",
                "give its feed: controls refuse it, or take one of their own");
    return false;
  }

  // A thread's way back follows a spindle that turns again.
  [[nodiscard]] double spindle_speed_for(const Feed& feed) const {
    return feed.synchronised ? state_.modes().spindle.speed : state_.modes().spindle_speed();
  }

  double minutes_for(const PlannedBlock& block, const BlockMotion& motion) {
    if (block.feed == nullptr || !has_feed(block.feed)) return 0.0;
    const auto minutes =
        minutes_of(*block.feed, motion.feed_length(), spindle_speed_for(*block.feed));
    if (minutes) return *minutes;
    state_.fail(minutes.error().front());
    return 0.0;
  }

  void split(const BlockPart& part, const AxisPositions& end, int depth) {
    if (keeps_to_path(state_, part, end, depth)) {
      if (part.to < 1.0) ++state_.out.inserted;
      output_.write(part, end, {});
      return;
    }
    if (depth >= kDeepest) {
      state_.fail(
          "tolerance-too-small"_id,
          "the block cannot be followed within the tolerance however many points are inserted",
          "allow more with --tolerance and --angle-tolerance, or divide the block");
      return;
    }
    const double middle = 0.5 * (part.from + part.to);
    split({part.block, part.motion, part.from, middle, part.minutes}, part.motion.at(middle),
          depth + 1);
    if (!state_.problems.empty()) return;
    split({part.block, part.motion, middle, part.to, part.minutes}, end, depth + 1);
  }

  // --- rewinding --------------------------------------------------------------------------------

  // Lifts off, turns the rotary axes to where the next block can be cut, and comes back.
  void rewind(const AxisPositions& back, const CompensationChange& wanted, bool cutting) {
    const Machine& machine = state_.machine;
    const double length = state_.length();
    const ToolPose here =
        kinematics::tool_pose(kinematics::nominal_pose(machine, state_.q, length));
    const Vec3 lifted = here.tip + state_.options.lift.value * here.axis;
    AxisPositions up = kinematics::place_tip(machine, lifted, length, state_.q);
    if (!kinematics::travel_violations(machine, up).empty()) up = state_.q;
    const AxisPositions above =
        up == state_.q ? back : kinematics::place_tip(machine, lifted, length, back);
    state_.compensate(wanted);
    state_.note("REWIND OF THE ROTARY AXES");
    const PlannedBlock rapid{};
    write_straight(rapid, up);
    state_.retract();
    AxisTarget aside;
    for (const auto& joint : machine.joints()) {
      if (joint.letter != AxisLetter::Z) aside[joint.letter] = above[joint.letter];
    }
    move_axes(aside, nullptr);
    state_.compensate(wanted);
    write_straight(rapid, above);
    const Feed feed{state_.options.lift_feed, parser::FeedMode::per_minute};
    PlannedBlock down;
    if (cutting) down.feed = &feed;
    write_straight(down, back);
    ++state_.out.rewinds;
  }

  // Rotary axes are at rest; straight in any form of output.
  void write_straight(const PlannedBlock& block, const AxisPositions& to) {
    if (!state_.within_travel(to)) return;
    PlannedBlock full = block;
    for (const auto& joint : state_.machine.joints()) full.end[joint.letter] = 0.0;
    const BlockMotion motion = kinematics::axes_motion(state_.q, to);
    if (motion.feed_length() <= kNoTravel) return;
    const double minutes = block.feed == nullptr ? 0.0 : motion.feed_length() / block.feed->value;
    output_.write({full, motion, 0.0, 1.0, minutes}, to, {});
  }

  std::span<const Motion> program_;
  PlanOptions options_;
  std::size_t at_ = 0;
  // Position of Z that the program has since a tool change that keeps it, while Z is at its home.
  std::optional<double> stays_at_{};
  PlanState state_;
  RotaryChoice rotary_{state_};
  BlockOutput output_{state_, rotary_};
  bool flood_ = false;
  bool ended_ = false;
};

}  // namespace

Result<MachineProgram> plan_for_machine(const Machine& machine, const kinematics::Setup& setup,
                                        std::span<const Motion> motions,
                                        const PlanOptions& options) {
  return Planner(machine, setup, motions, options).plan();
}

}  // namespace frustum::post

#include "post/planning/machine_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/rotary_axes.hpp"
#include "post/planning/block_feed.hpp"
#include "post/planning/output_arc.hpp"
#include "post/planning/pose_run.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisPositions;
using kinematics::BlockMotion;
using kinematics::kRotaryAxes;
using kinematics::linear_positions;
using kinematics::Machine;
using kinematics::PlannedPose;
using kinematics::TipCurve;
using kinematics::ToolPose;
using parser::AxisLetter;
using parser::AxisTarget;
using parser::CompensationChange;
using parser::Coordinates;
using parser::Feed;
using parser::FeedMode;
using parser::LengthCompensation;
using parser::Motion;

// rad and mm: below any written word; an axis that moves by less stands.
constexpr double kStanding = 1e-12;
constexpr int kDeepest = 18;  // 262,144 points a block

AxisPositions with_rotary_of(AxisPositions q, const AxisPositions& rotary) {
  for (const AxisLetter letter : kRotaryAxes) q[letter] = rotary[letter];
  return q;
}

// A block of the program: what moves, and what is asked of it.
struct Block {
  AxisTarget end{};
  std::optional<UnitVec3> tool_axis{};
  const Feed* feed = nullptr;  // none: rapid
  const parser::ArcFeed* arc = nullptr;
};

class Planner {
 public:
  Planner(const Machine& machine, const kinematics::Setup& setup, std::span<const Motion> motions,
          const PlanOptions& options)
      : machine_(machine),
        setup_(setup),
        program_(motions),
        options_(options),
        q_(machine.home()) {}

  Result<MachineProgram> plan() {
    for (at_ = 0; at_ < program_.size() && problems_.empty(); ++at_) {
      place_ = program_[at_].place;
      std::visit([this](const auto& command) { follow(command); }, program_[at_].command);
      if (ended_) break;
    }
    if (!ended_ && problems_.empty()) follow(parser::Stop{});
    if (!problems_.empty()) return problems_;
    return std::move(out_);
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
    fail("a probing move is not post-processed: what follows depends on what it meets",
         "leave the blocks that probe out, and give their results as numbers");
  }
  // Not every dialect has a word for home; its place is known here.
  void follow(const parser::HomeReturn& home) {
    if (home.point != 1) {
      fail(fmt::format("G30: the machine has no reference point {}", home.point),
           "store the point with G30.1 before, or give it in machine coordinates (G53)");
      return;
    }
    AxisTarget end;
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (home.axes.at(static_cast<std::size_t>(letter)) && present(letter)) {
        end[letter] = machine_.home()[letter];
      }
    }
    if (problems_.empty()) move_axes(end, nullptr);
  }
  void follow(const parser::ToolChange& change) {
    if (spindle_.direction != parser::SpindleDirection::off) {
      follow(parser::SpindleChange{parser::SpindleDirection::off, spindle_.speed});
    }
    retract();
    compensate({});
    emit(change);
  }
  void follow(const parser::CompensationChange& change) {
    if (change.length) {
      fail("a program that sets its tool lengths itself",
           "take the lengths from the job: leave out G43.1, G43.2 and G10 L1, L10, L11");
      return;
    }
    compensation_ = change;
  }
  void follow(const parser::WorkOffsetChange& change) {
    if (!known_offset(change.number)) return;
    offset_ = change.number;
    emit(change);
  }
  void follow(const parser::WorkOffsetSetting& setting) {
    fail(fmt::format("a program that places {} itself", parser::work_offset_name(setting.number)),
         "leave out G10 and give its origin in the table frame: [offsets] of a job, or --offset");
  }
  void follow(const parser::OrientationPathChange& change) {
    orientation_ = change.path;
    if (options_.great_circle) emit(change);
  }
  void follow(const parser::RotaryPathChange& change) {
    for (std::size_t i = 0; i < change.axes.size(); ++i) {
      if (change.axes.at(i)) rotary_paths_.at(i) = change.path;
    }
  }
  void follow(const parser::TiltedPlaneChange& change) { plane_ = change.program_from_plane; }
  void follow(const parser::AlignToPlane& /*align*/) {
    if (!plane_) {
      fail("alignment to a tilted plane, but there is none", "define the plane before");
      return;
    }
    if (tip_control(compensation_)) {  // the tip stays on the work
      go({.tool_axis = UnitVec3::z()});
      return;
    }
    const auto aligned = kinematics::nearest_orientation(machine_, q_, plane_->rotation.col(2));
    if (!aligned) {
      fail(aligned.error().front());
      return;
    }
    AxisTarget end;
    for (const AxisLetter letter : kRotaryAxes) {
      if (machine_.joint(letter) != nullptr) end[letter] = (*aligned)[letter];
    }
    move_axes(end, nullptr);
  }
  void follow(const parser::SpindleChange& change) {
    spindle_ = change;
    emit(change);
  }
  void follow(const parser::CoolantChange& change) {
    flood_ = change.flood;
    emit(change);
  }
  void follow(const parser::Dwell& dwell) { emit(dwell); }
  void follow(const parser::Event& event) { emit(event); }
  void follow(const parser::Stop& stop) {
    if (stop.kind == parser::StopKind::program_end) {
      retract();
      compensate({});
      if (spindle_.direction != parser::SpindleDirection::off) {
        follow(parser::SpindleChange{parser::SpindleDirection::off, spindle_.speed});
      }
      if (flood_) follow(parser::CoolantChange{false});
      ended_ = true;
    }
    emit(stop);
  }

  // --- motion -----------------------------------------------------------------------------------

  // Machine coordinates: axis positions in every form of output.
  void move_axes(const AxisTarget& end, const Feed* feed) {
    AxisPositions to = q_;
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (!end[letter]) continue;
      if (!present(letter)) return;
      to[letter] = *end[letter];
      if (parser::is_rotary(letter)) {
        turns_[letter] = 0.0;
        written_[letter] = to[letter];
        flipped_ = false;
      }
    }
    if (!within_travel(to)) return;
    if (compensation_.mode == LengthCompensation::off || tip_control(applied_)) compensate({});
    if (feed == nullptr) {
      emit(parser::Traverse{end, std::nullopt, Coordinates::machine});
    } else {
      emit(parser::LinearFeed{end, std::nullopt, Coordinates::machine, *feed});
    }
    q_ = to;
    moved_ = true;
    const auto& z = end[AxisLetter::Z];
    if (z) retracted_ = *z >= machine_.home()[AxisLetter::Z] - kStanding;
  }

  void go(const Block& block) {
    for (const AxisLetter letter : parser::kAxisLetters) {
      if (block.end[letter] && !present(letter)) return;
    }
    if (!known_offset(offset_)) return;
    if (!moved_) retract();
    const bool tip_words = tip_control(compensation_) || plane_.has_value();
    if (!tip_words && block.tool_axis) {
      fail("tool vector without tool-centre-point control", "switch it on before");
      return;
    }
    const CompensationChange wanted = output_compensation();
    const bool same_words = tip_words == tip_control(wanted);
    if (!length_known(compensation_.offset_number, same_words)) return;
    if (tip_words) {
      move_tip(block, wanted);
    } else {
      move_words(block, wanted);
    }
  }

  void move_tip(const Block& block, const CompensationChange& wanted) {
    const Pose table_from_words = Pose::translated(offset()) * plane_.value_or(Pose{});
    const Vec3 start = table_from_words.inverse().point(tip_at(q_));
    const Vec3 end = with_words(start, block.end);
    const ToolPose wanted_pose{table_from_words.point(end), Vec3::UnitZ()};
    if (orientation_ == parser::OrientationPath::great_circle) {
      move_on_great_circle(block, wanted, table_from_words, start, end);
      return;
    }
    const auto rotary = rotary_end(block, wanted_pose, table_from_words);
    if (!rotary) return;
    if (rotary->unwind) rewind(rotary->resume, wanted, block.feed != nullptr);
    if (!problems_.empty()) return;
    const BlockMotion motion = kinematics::tip_motion(
        machine_, q_, rotary->axes, curve_of(block, start, end), frame_of(table_from_words));
    hand_on(block, motion, wanted, tip_control(wanted),
            [&] { return arc_image(block, wanted, table_from_words.rotation, start); });
  }

  // The way decides where the rotary axes end: on the solution that they are on, but for the pole.
  void move_on_great_circle(const Block& block, const CompensationChange& wanted,
                            const Pose& table_from_words, const Vec3& start, const Vec3& end) {
    AxisPositions written = q_;
    for (const AxisLetter letter : kRotaryAxes) {
      if (block.end[letter]) written[letter] = *block.end[letter];
    }
    const Vec3 axis = block.tool_axis
                          ? table_from_words.direction(*block.tool_axis)
                          : Vec3(kinematics::nominal_pose(machine_, written, 0.0).rotation.col(2));
    const auto motion = kinematics::vector_motion(machine_, q_, axis, curve_of(block, start, end),
                                                  frame_of(table_from_words));
    if (!motion) {
      fail(motion.error().front());
      return;
    }
    vector_block_ = true;
    end_of_rotary_ = motion->end();
    hand_on(block, *motion, wanted, tip_control(wanted) && options_.great_circle,
            [&] { return arc_image(block, wanted, table_from_words.rotation, start); });
  }

  [[nodiscard]] static TipCurve curve_of(const Block& block, const Vec3& start, const Vec3& end) {
    return block.arc == nullptr ? TipCurve::line(start, end)
                                : TipCurve::arc(*block.arc, start, end);
  }

  void move_words(const Block& block, const CompensationChange& wanted) {
    const Vec3 shift = axis_shift();
    const Vec3 start = linear_positions(q_) - shift;
    const Vec3 end = with_words(start, block.end);
    vector_block_ = false;
    AxisPositions rotary = q_;
    for (const AxisLetter letter : kRotaryAxes) {
      if (block.end[letter]) rotary[letter] = turned(letter, *block.end[letter]);
    }
    end_of_rotary_ = rotary;
    const BlockMotion motion =
        kinematics::words_motion(q_, rotary, curve_of(block, start, end), shift);
    hand_on(block, motion, wanted, !tip_control(wanted), [&] {
      return arc_image(block, wanted, kinematics::linear_axis_directions(machine_, q_), start);
    });
  }

  // One block, or as many as it takes. `followed`: the reader follows a straight block as it stands.
  template <typename Image>
  void hand_on(const Block& block, const BlockMotion& motion, const CompensationChange& wanted,
               bool followed, const Image& image) {
    if (!way_within_travel(motion)) return;
    compensate(wanted);
    const double minutes = minutes_of(block, motion);
    if (!problems_.empty()) return;
    const Piece whole{block, motion, 0.0, 1.0, minutes};
    if (block.arc != nullptr) {
      if (const auto arc = image()) {
        emit_piece(whole, motion.end(), arc);
        return;
      }
    } else if (followed) {
      emit_piece(whole, motion.end(), {});
      return;
    }
    split(whole, motion.end(), 0);
  }

  // A part of a block, from where the axes are.
  struct Piece {
    const Block& block;
    const BlockMotion& motion;
    double from = 0.0, to = 1.0;  // fractions of the block
    double minutes = 0.0;         // of the whole block
  };

  void split(const Piece& piece, const AxisPositions& end, int depth) {
    if (keeps_to(piece, end, depth)) {
      if (piece.to < 1.0) ++out_.inserted;
      emit_piece(piece, end, {});
      return;
    }
    if (depth >= kDeepest) {
      fail("the block cannot be followed within the tolerance however many points are inserted",
           "allow more with --tolerance and --angle-tolerance, or divide the block");
      return;
    }
    const double middle = 0.5 * (piece.from + piece.to);
    split({piece.block, piece.motion, piece.from, middle, piece.minutes}, piece.motion.at(middle),
          depth + 1);
    if (!problems_.empty()) return;
    split({piece.block, piece.motion, middle, piece.to, piece.minutes}, end, depth + 1);
  }

  // Whether the controller, going straight in the output's words, keeps to the programmed path.
  [[nodiscard]] bool keeps_to(const Piece& piece, const AxisPositions& end, int depth) const {
    // Eighths of a whole block, quarters of its parts, and never so few that turns hide between.
    const double least = piece.motion.least_parts() * (piece.to - piece.from);
    const int parts = std::max(depth == 0 ? 8 : 4, static_cast<int>(std::ceil(least)));
    const bool tip_output = tip_control(applied_);
    const Vec3 tip_from = tip_at(q_), tip_to = tip_at(end);
    for (int i = 1; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      const Pose programmed = kinematics::nominal_pose(
          machine_, piece.motion.at(piece.from + s * (piece.to - piece.from)), length());
      const Pose reached =
          kinematics::nominal_pose(machine_, kinematics::part_way(q_, end, s), length());
      const Vec3 tip = tip_output ? Vec3(tip_from + s * (tip_to - tip_from)) : reached.translation;
      if ((tip - programmed.translation).norm() > options_.tolerance.value) return false;
      const double turn = angle_between(programmed.rotation.col(2), reached.rotation.col(2));
      if (turn > options_.angle_tolerance.value) return false;
    }
    return true;
  }

  void emit_piece(const Piece& piece, const AxisPositions& end,
                  const std::optional<ArcImage>& arc) {
    const AxisTarget words =
        words_at(end, given_letters(piece.block, arc || piece.to - piece.from == 1.0));
    std::optional<UnitVec3> vector;
    if (applied_.tool_vectors) {
      vector = UnitVec3::of(kinematics::nominal_pose(machine_, end, length()).rotation.col(2));
    }
    if (piece.block.feed == nullptr) {
      emit(parser::Traverse{words, vector, Coordinates::program});
    } else {
      const Feed feed = feed_of(piece, end, arc.has_value());
      if (arc) {
        emit(parser::ArcFeed{words, arc->center, arc->plane, arc->turns, vector, feed});
      } else {
        emit(parser::LinearFeed{words, vector, Coordinates::program, feed});
      }
    }
    q_ = end;
    retracted_ = false;
  }

  // The axis words that a block's last piece repeats: where nothing is converted, only those given.
  [[nodiscard]] AxisTarget given_letters(const Block& block, bool whole) const {
    const bool tip_words = tip_control(compensation_) || plane_.has_value();
    if (whole && tip_words == tip_control(applied_) && !plane_) return block.end;
    AxisTarget all;
    for (const auto& joint : machine_.joints()) all[joint.letter] = 0.0;
    return all;
  }

  // Words of the output that bring the axes to q.
  [[nodiscard]] AxisTarget words_at(const AxisPositions& q, const AxisTarget& letters) const {
    const Vec3 linear = tip_control(applied_) ? Vec3(tip_at(q) - offset())
                                              : Vec3(linear_positions(q) - axis_shift());
    AxisTarget words;
    for (const AxisLetter letter : kinematics::kLinearAxes) {
      if (letters[letter]) words[letter] = linear[static_cast<Eigen::Index>(letter)];
    }
    if (applied_.tool_vectors) return words;
    for (const AxisLetter letter : kRotaryAxes) {
      if (machine_.joint(letter) != nullptr && (letters[letter] || vector_block_)) {
        words[letter] = q[letter];
      }
    }
    return words;
  }

  std::optional<ArcImage> arc_image(const Block& block, const CompensationChange& wanted,
                                    const Mat3& table_from_in, const Vec3& start) const {
    if (block.arc == nullptr || options_.arcs == ArcForm::none) return {};
    const AxisPositions end = end_of_rotary_;
    if (rotary_travel(q_, end) > kStanding) return {};
    Mat3 out_from_in = table_from_in;
    Vec3 start_out = tip_at(q_) - offset();
    if (tip_control(wanted)) {
      const Vec3 axis = kinematics::nominal_pose(machine_, q_, 0.0).rotation.col(2);
      // rad: the cosine of the tilt is one within rounding.
      constexpr double kUpright = 1e-9;
      const Vec3 normal = table_from_in * normal_of(block.arc->plane);
      if (axis.cross(normal).norm() > kUpright) return {};
    } else {
      out_from_in = kinematics::linear_axis_directions(machine_, q_).inverse() * table_from_in;
      start_out = linear_positions(q_) - axis_shift();
    }
    auto image = image_of(*block.arc, out_from_in, start, start_out);
    if (image && options_.arcs == ArcForm::flat) {
      const Vec3 rise = with_words(start, block.end) - start;
      const bool flat = std::abs(rise.dot(normal_of(block.arc->plane))) <= kStanding;
      const bool in_xy = image->plane == parser::Plane::xy;
      if (!flat || !in_xy || std::abs(image->turns) > 1) return {};
    }
    return image;
  }

  // --- orientation --------------------------------------------------------------------------------

  // Where the rotary axes go. `pose` has the tip of the block's end, in the table frame.
  std::optional<PlannedPose> rotary_end(const Block& block, const ToolPose& pose,
                                        const Pose& table_from_words) {
    vector_block_ = block.tool_axis.has_value();
    std::optional<PlannedPose> planned;
    if (block.tool_axis) {
      planned = next_planned(table_from_words);
    } else {
      planned = written_end(block, pose.tip);
    }
    if (planned) end_of_rotary_ = with_rotary_of(q_, planned->axes);
    return planned;
  }

  // A rotary word, with the full turns that a rewind took off, or the shortest way.
  [[nodiscard]] double turned(AxisLetter letter, double word) const {
    const auto path = rotary_paths_.at(static_cast<std::size_t>(letter) - 3);
    if (path == parser::RotaryPath::as_programmed) return word + turns_[letter];
    return kinematics::turn_to(*machine_.joint(letter), word, q_[letter], path);
  }

  // Rotary words as they are while the axes are on the solution that the program means; else the positions
  // nearest to where they are that point the tool the same way.
  std::optional<PlannedPose> written_end(const Block& block, const Vec3& tip) {
    PlannedPose as_written{.axes = q_};
    for (const AxisLetter letter : kRotaryAxes) {
      if (block.end[letter]) written_[letter] = *block.end[letter];
      if (block.end[letter]) as_written.axes[letter] = turned(letter, *block.end[letter]);
    }
    if (!flipped_) {
      return rotary_within_travel(as_written.axes) ? as_written : turned_back(as_written, tip);
    }
    const Vec3 axis =
        kinematics::nominal_pose(machine_, with_rotary_of(q_, written_), 0.0).rotation.col(2);
    const auto nearest = kinematics::nearest_orientation(machine_, q_, axis);
    if (nearest) return PlannedPose{.axes = *nearest};
    as_written.axes = with_rotary_of(q_, written_);
    return turned_back(as_written, tip);
  }

  // The words are out of travel: the same direction by other positions.
  std::optional<PlannedPose> turned_back(const PlannedPose& written, const Vec3& tip) {
    const Vec3 axis = kinematics::nominal_pose(machine_, written.axes, 0.0).rotation.col(2);
    const auto planned = plan_poses({.poses = {{tip, axis}}, .from_here = true});
    if (planned.empty()) return {};
    const PlannedPose next = planned.front();
    for (const AxisLetter letter : kRotaryAxes) {
      const double off = next.axes[letter] - written.axes[letter];
      const double turns = kTurn * std::round(off / kTurn);
      turns_[letter] += turns;
      constexpr double kSameAngle = 1e-6;  // rad
      if (std::abs(off - turns) > kSameAngle) flipped_ = true;
    }
    return next;
  }

  // Vectors are planned together, from here to where something else moves the axes.
  std::optional<PlannedPose> next_planned(const Pose& table_from_words) {
    if (planned_.empty()) {
      const auto planned = plan_poses(vector_run(
          program_.subspan(at_), table_from_words.inverse().point(tip_at(q_)), table_from_words));
      planned_.assign(planned.begin(), planned.end());
      if (planned_.empty()) return {};
    }
    const PlannedPose next = planned_.front();
    planned_.pop_front();
    return next;
  }

  // Empty: there is no way, and the problem is told.
  std::vector<PlannedPose> plan_poses(const PoseRun& run) {
    // What reads vectors takes the nearest solution; without lengths travels cannot be looked at.
    const bool nearest = options_.output == OutputForm::vectors || lengths_missing_;
    auto planned = choose_axes(machine_, run, q_, length(),
                               nearest ? AxisChoice::nearest : AxisChoice::along_the_path);
    if (planned) return *std::move(planned);
    fail(planned.error().front());
    return {};
  }

  // Lifts off, turns the rotary axes to where the next block can be cut, and comes back.
  void rewind(const AxisPositions& back, const CompensationChange& wanted, bool cutting) {
    const ToolPose here = kinematics::tool_pose(kinematics::nominal_pose(machine_, q_, length()));
    const Vec3 lifted = here.tip + options_.lift.value * here.axis;
    AxisPositions up = kinematics::place_tip(machine_, lifted, length(), q_);
    if (!kinematics::travel_violations(machine_, up).empty()) up = q_;
    const AxisPositions above =
        up == q_ ? back : kinematics::place_tip(machine_, lifted, length(), back);
    compensate(wanted);
    note("REWIND OF THE ROTARY AXES");
    const Block rapid{};
    emit_straight(rapid, up);
    retract();
    AxisTarget aside;
    for (const auto& joint : machine_.joints()) {
      if (joint.letter != AxisLetter::Z) aside[joint.letter] = above[joint.letter];
    }
    move_axes(aside, nullptr);
    compensate(wanted);
    emit_straight(rapid, above);
    const Feed feed{options_.lift_feed, FeedMode::per_minute};
    Block down;
    if (cutting) down.feed = &feed;
    emit_straight(down, back);
    ++out_.rewinds;
  }

  // Rotary axes stand; straight in any form of output.
  void emit_straight(const Block& block, const AxisPositions& to) {
    if (!within_travel(to)) return;
    Block full = block;
    for (const auto& joint : machine_.joints()) full.end[joint.letter] = 0.0;
    const BlockMotion motion = kinematics::axes_motion(q_, to);
    if (motion.feed_length() <= kStanding) return;
    const double minutes = block.feed == nullptr ? 0.0 : motion.feed_length() / block.feed->value;
    emit_piece({full, motion, 0.0, 1.0, minutes}, to, {});
  }

  // --- feed ---------------------------------------------------------------------------------------

  double minutes_of(const Block& block, const BlockMotion& motion) {
    if (block.feed == nullptr) return 0.0;
    const auto minutes = post::minutes_of(*block.feed, motion.feed_length(), spindle_.speed);
    if (minutes) return *minutes;
    fail(minutes.error().front());
    return 0.0;
  }

  [[nodiscard]] Feed feed_of(const Piece& piece, const AxisPositions& end, bool arc) const {
    const bool tip_words = tip_control(applied_);
    const Vec3 way = tip_words ? Vec3(tip_at(end) - tip_at(q_))
                               : Vec3(linear_positions(end) - linear_positions(q_));
    return feed_for(*piece.block.feed, {.minutes = piece.minutes * (piece.to - piece.from),
                                        .length = way.norm(),
                                        .turn = rotary_travel(q_, end),
                                        .tip_words = tip_words,
                                        .arc = arc});
  }

  // --- states -------------------------------------------------------------------------------------

  [[nodiscard]] static bool tip_control(const CompensationChange& compensation) {
    return compensation.mode == LengthCompensation::tool_centre_point;
  }

  // What the output needs switched on for a block under the program's own compensation.
  [[nodiscard]] CompensationChange output_compensation() const {
    if (compensation_.mode == LengthCompensation::off) return {};
    CompensationChange wanted = compensation_;
    wanted.mode = options_.output == OutputForm::axes ? LengthCompensation::length
                                                      : LengthCompensation::tool_centre_point;
    wanted.tool_vectors = options_.output == OutputForm::vectors;
    return wanted;
  }

  void compensate(const CompensationChange& wanted) {
    const bool same = applied_.mode == wanted.mode &&
                      applied_.tool_vectors == wanted.tool_vectors &&
                      applied_.offset_number == wanted.offset_number;
    if (same) return;
    applied_ = wanted;
    emit(wanted);
  }

  // Z to its home, where nothing is in the way.
  void retract() {
    if (retracted_) return;
    AxisTarget up;
    up[AxisLetter::Z] = machine_.home()[AxisLetter::Z];
    if (tip_control(applied_)) compensate({});
    emit(parser::Traverse{up, std::nullopt, Coordinates::machine});
    q_[AxisLetter::Z] = *up[AxisLetter::Z];
    retracted_ = true;
    moved_ = true;
  }

  // --- the machine at work --------------------------------------------------------------------------

  [[nodiscard]] double length() const {
    const auto tool = setup_.tools.find(compensation_.offset_number);
    const bool off = compensation_.mode == LengthCompensation::off;
    return off || tool == setup_.tools.end() ? 0.0 : tool->second.length;
  }
  [[nodiscard]] std::shared_ptr<const kinematics::TipFrame> frame_of(const Pose& words) const {
    return std::make_shared<const kinematics::TipFrame>(kinematics::TipFrame{words, length()});
  }
  [[nodiscard]] Vec3 offset() const { return setup_.work_offsets.at(offset_); }
  [[nodiscard]] Vec3 tip_at(const AxisPositions& q) const {
    return kinematics::nominal_pose(machine_, q, length()).translation;
  }
  // What to add to X Y Z words to get axis positions: at rotary zero the tip is where the words say.
  [[nodiscard]] Vec3 axis_shift() const {
    return linear_positions(kinematics::place_tip(machine_, offset(), length(), {}));
  }

  // --- checks ---------------------------------------------------------------------------------------

  bool present(AxisLetter letter) {
    if (machine_.joint(letter) != nullptr) return true;
    fail(fmt::format("machine {} ({}) has no axis {}", machine_.name(), machine_.structure(),
                     parser::to_char(letter)),
         "post-process a program with tool vectors, or choose a machine with that axis");
    return false;
  }
  bool known_offset(int number) {
    if (setup_.work_offsets.contains(number)) return true;
    fail(fmt::format("work offset G{} is not defined", 53 + number),
         fmt::format("give its origin in the table frame: G{} under [offsets] of a job, or "
                     "--offset G{}=X,Y,Z",
                     53 + number, 53 + number));
    return false;
  }
  // Axis positions depend on the tool's length, tip coordinates do not.
  bool length_known(int number, bool same_words) {
    if (compensation_.mode == LengthCompensation::off || setup_.tools.contains(number)) return true;
    if (same_words) {
      if (!lengths_missing_) {
        Diagnostic note = warning(
            fmt::format("the length of tool {} is not known: travels of X Y Z are not checked",
                        number),
            fmt::format("give it with --tool-length {}=LENGTH or a job", number));
        locate(note);
        out_.warnings.push_back(note);
      }
      lengths_missing_ = true;
      return true;
    }
    fail(number == 0 ? std::string("tool length compensation without an H word")
                     : fmt::format("axis positions need the length of tool {}", number),
         fmt::format("give it with --tool-length {}=LENGTH, or a job with --job", number));
    return false;
  }

  [[nodiscard]] std::vector<std::string> violations(const AxisPositions& q) const {
    if (!lengths_missing_) return kinematics::travel_violations(machine_, q);
    return kinematics::travel_violations(machine_, with_rotary_of(machine_.home(), q));
  }
  [[nodiscard]] bool rotary_within_travel(const AxisPositions& q) const {
    return kinematics::travel_violations(machine_, with_rotary_of(machine_.home(), q)).empty();
  }
  bool within_travel(const AxisPositions& q) {
    const auto found = violations(q);
    if (found.empty()) return true;
    fail(fmt::format("over-travel: {}", fmt::join(found, "; ")),
         "move the workpiece on the table, or choose a larger machine");
    return false;
  }
  bool way_within_travel(const BlockMotion& motion) {
    const int parts = motion.least_parts();
    for (int i = parts; i > 0; --i) {
      if (!within_travel(motion.at(static_cast<double>(i) / parts))) return false;
    }
    return true;
  }

  void fail(std::string message, std::string hint) {
    fail(error(std::move(message), std::move(hint)));
  }
  void fail(Diagnostic problem) {
    locate(problem);
    problems_.push_back(std::move(problem));
  }
  void locate(Diagnostic& diagnostic) const {
    if (place_.file) diagnostic.file = *place_.file;
    diagnostic.line = static_cast<int>(place_.line);
    diagnostic.column = static_cast<int>(place_.column);
  }

  void note(std::string text) { emit(parser::Event{"comment", std::move(text)}); }
  void emit(parser::Command command) { out_.motions.push_back({place_, std::move(command)}); }

  const Machine& machine_;
  const kinematics::Setup& setup_;
  std::span<const Motion> program_;
  const PlanOptions& options_;

  // Of the program.
  std::size_t at_ = 0;
  parser::SourcePlace place_{};
  CompensationChange compensation_{};
  int offset_ = 1;
  std::optional<Pose> plane_{};
  parser::OrientationPath orientation_ = parser::OrientationPath::rotary_axes;
  std::array<parser::RotaryPath, 3> rotary_paths_{};  // A, B, C
  parser::SpindleChange spindle_{};
  bool flood_ = false;
  bool ended_ = false;
  // Of the machine.
  AxisPositions q_;
  AxisPositions turns_{};          // full turns added to the program's rotary words
  AxisPositions written_{};        // the program's rotary words
  bool flipped_ = false;           // a rewind went to the other solution for the tool axis
  AxisPositions end_of_rotary_{};  // of the block at work
  std::deque<PlannedPose> planned_{};
  bool vector_block_ = false;  // the block at work names its direction by a vector
  bool retracted_ = false;     // Z is at its home
  bool moved_ = false;
  bool lengths_missing_ = false;
  // Of the output.
  CompensationChange applied_{};
  MachineProgram out_{};
  Diagnostics problems_{};
};

}  // namespace

Result<MachineProgram> plan_for_machine(const Machine& machine, const kinematics::Setup& setup,
                                        std::span<const Motion> motions,
                                        const PlanOptions& options) {
  return Planner(machine, setup, motions, options).plan();
}

}  // namespace frustum::post

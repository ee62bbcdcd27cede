#include "kinematics/controller/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/rotary_axes.hpp"
#include "kinematics/model/work_offset.hpp"
#include "kinematics/path/path_recorder.hpp"

namespace frustum::kinematics {
namespace {

using parser::AxisTarget;
using parser::Coordinates;
using parser::LengthCompensation;
using parser::Motion;

constexpr int kJobOffsets = 6;  // G54 to G59

}  // namespace

class Controller::State {
 public:
  State(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
        const ControllerOptions& options)
      : machine_(machine),
        setup_(setup),
        options_(options),
        work_offsets_(setup.work_offsets),
        q_(machine.home()),
        recorder_(machine, errors, setup.table_from_workpiece.inverse(), q_,
                  {options.path_bound, options.time_law, options.servo_lag, options.sink}) {
    execution_.axes.push_back({0, PathKind::rapid, q_});
  }

  bool run(const Motion& motion) {
    if (!problems_.empty()) return false;
    place_ = motion.place;
    std::visit([this](const auto& command) { execute(command); }, motion.command);
    if (problems_.empty()) return true;
    if (!options_.problems) return false;
    for (Diagnostic& problem : problems_) options_.problems(std::move(problem));
    problems_.clear();
    return true;
  }

  Result<Execution> finish() {
    if (!problems_.empty()) return problems_;
    execution_.path = recorder_.finish();
    execution_.cycle_time = recorder_.clock();
    return std::move(execution_);
  }

 private:
  // --- commands -------------------------------------------------------------------------------

  void execute(const parser::Traverse& move) {
    go(move.end, move.tool_axis, move.coordinates, {PathKind::rapid}, nullptr);
  }
  void execute(const parser::LinearFeed& move) {
    go(move.end, move.tool_axis, move.coordinates, {PathKind::feed, move.feed}, nullptr);
  }
  void execute(const parser::ArcFeed& move) {
    go(move.end, move.tool_axis, Coordinates::program, {PathKind::feed, move.feed}, &move);
  }
  // There is no part that it could meet.
  void execute(const parser::Probe& move) {
    warn(move.must_meet ? "the probe meets nothing here, where a control would stop with an alarm: "
                          "it goes to the end of its move"
                        : "the probe meets nothing here: it goes to the end of its move");
    go(move.end, move.tool_axis, Coordinates::program, {PathKind::feed, move.feed}, nullptr);
  }
  void execute(const parser::HomeReturn& move) {
    if (move.point != 1) {
      fail(fmt::format("G30: the machine has no reference point {}", move.point),
           "store the point with G30.1 before, or give it in machine coordinates (G53)");
      return;
    }
    AxisPositions end = q_;
    const AxisPositions home = machine_.home();
    for (const AxisLetter letter : kAxisLetters) {
      if (move.axes[static_cast<std::size_t>(letter)] && present(letter))
        end[letter] = home[letter];
    }
    if (problems_.empty()) travel(axes_motion(q_, end), {PathKind::rapid});
  }
  void execute(const parser::ToolChange& change) {
    if (change.tool != 0 && !setup_.tools.contains(change.tool)) {
      fail(fmt::format("tool T{} is not defined", change.tool),
           fmt::format("add tool.{} to the job; a tool is never replaced by another", change.tool));
      return;
    }
    tool_ = change.tool;
    rest(0.0);
    recorder_.break_chain();
  }
  void execute(const parser::CompensationChange& change) {
    if (change.mode == LengthCompensation::off) {
      compensation_ = change.mode;
      compensated_length_ = 0.0;
      return;
    }
    if (change.length) {
      compensation_ = change.mode;
      compensated_length_ = *change.length;
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
    const auto offset = work_offsets_.find(change.number);
    if (offset == work_offsets_.end()) {
      const std::string name = parser::work_offset_name(change.number);
      fail(fmt::format("work offset {} is not defined", name),
           change.number <= kJobOffsets
               ? fmt::format("add {} to [offsets] of the job", name)
               : std::string("use G54 to G59, or place it with G10 L2 before"));
      return;
    }
    offset_ = offset->second;
    offset_number_ = change.number;
    offset_known_ = true;
    place_words();
  }
  void execute(const parser::WorkOffsetSetting& setting) {
    const auto before = work_offsets_.find(setting.number);
    const auto origin =
        placed_origin(machine_, setting,
                      before == work_offsets_.end() ? std::nullopt : std::optional(before->second));
    if (!origin) {
      const std::string name = parser::work_offset_name(setting.number);
      fail(fmt::format("the program places {} along some axes, and nothing gives the others", name),
           "give X, Y and Z in the setting");
      return;
    }
    work_offsets_[setting.number] = *origin;
    if (setting.number == offset_number_) execute(parser::WorkOffsetChange{offset_number_});
  }
  void execute(const parser::SpindleChange& change) {
    spindle_on_ = change.direction != parser::SpindleDirection::off && change.speed > 0.0;
    spindle_speed_ = spindle_on_ ? change.speed : 0.0;
  }
  void execute(const parser::OrientationPathChange& change) { orientation_path_ = change.path; }
  void execute(const parser::RotaryPathChange& change) {
    for (std::size_t i = 0; i < change.axes.size(); ++i) {
      if (change.axes.at(i)) rotary_paths_.at(i) = change.path;
    }
  }
  void execute(const parser::TiltedPlaneChange& change) {
    plane_ = change.program_from_plane;
    place_words();
  }
  void execute(const parser::AlignToPlane& /*align*/) {
    if (!plane_) {
      fail("the tool is to be set square to a tilted plane, but none is active",
           "define the plane first, for example with G68.2");
      return;
    }
    if (!know_offset()) return;
    const Vec3 normal = table_from_words_.direction(Vec3::UnitZ());
    const Vec3 tip = nominal_pose(machine_, q_, compensated_length_).translation;
    AxisPositions end = q_;
    if (!orient_to(normal, tip, end)) return;
    if (compensation_ == LengthCompensation::tool_centre_point) {
      const Vec3 words = table_from_words_.inverse().point(tip);
      travel(tip_motion(machine_, q_, end, TipCurve::line(words, words), tip_frame()),
             {PathKind::rapid});
    } else {
      travel(axes_motion(q_, with_linear_positions(end, linear_positions(q_))), {PathKind::rapid});
    }
  }
  void execute(const parser::Dwell& dwell) { rest(dwell.seconds); }
  void execute(const parser::CoolantChange& /*change*/) {}
  void execute(const parser::Stop& stop) {
    if (stop.kind == parser::StopKind::optional_stop) return;
    spindle_on_ = false;
    rest(0.0);
  }
  void execute(const parser::Event& /*event*/) {}

  // --- motion ---------------------------------------------------------------------------------

  struct Manner {
    PathKind kind = PathKind::rapid;
    parser::Feed feed{};
  };

  void go(const AxisTarget& target, const std::optional<UnitVec3>& tool_axis,
          Coordinates coordinates, const Manner& manner, const parser::ArcFeed* arc) {
    for (const AxisLetter letter : kAxisLetters) {
      if (target[letter] && !present(letter)) return;
    }
    if (manner.kind == PathKind::feed && tool_ == 0 && options_.feeds_need_tool) {
      fail("feed move without a tool in the spindle", "call a tool first, for example T1 M6");
      return;
    }
    if (coordinates == Coordinates::machine) {
      AxisPositions end = rotary_end(target);
      for (const AxisLetter letter : kLinearAxes) {
        if (target[letter]) end[letter] = *target[letter];
      }
      travel(axes_motion(q_, end), manner);
      return;
    }
    if (!know_offset()) return;
    const bool centre_point = compensation_ == LengthCompensation::tool_centre_point;
    if (tool_axis && !centre_point) {
      fail("tool vector words I J K without tool-centre-point control",
           "switch it on with G43.5 H or G43.4 H");
    } else if (centre_point || (plane_ && arc != nullptr)) {
      move_tip(target, tool_axis, manner, arc);
    } else if (plane_) {
      move_in_plane(target, manner);
    } else {
      move_words(target, manner, arc);
    }
  }

  // Tool-centre-point control: tip as programmed, the rotary axes or the tool axis on their own path.
  void move_tip(const AxisTarget& target, const std::optional<UnitVec3>& tool_axis,
                const Manner& manner, const parser::ArcFeed* arc) {
    const Vec3 start = tip_in_words();
    const Vec3 end = linear_words(target, start);
    const TipCurve tip = curve(arc, start, end);
    AxisPositions q_end = rotary_end(target);
    if (orientation_path_ == parser::OrientationPath::great_circle) {
      const Vec3 axis = tool_axis ? table_from_words_.direction(*tool_axis)
                                  : Vec3(nominal_pose(machine_, q_end, 0.0).rotation.col(2));
      if (turns_tool(axis)) {
        move_on_great_circle(tip, axis, tool_axis ? nullptr : &q_end, manner);
        return;
      }
    }
    if (tool_axis &&
        !orient_to(table_from_words_.direction(*tool_axis), table_from_words_.point(end), q_end)) {
      return;
    }
    travel(tip_motion(machine_, q_, q_end, tip, tip_frame()), manner);
  }

  [[nodiscard]] bool turns_tool(const Vec3& to_axis) const {
    // Below what nine written digits of a direction can tell.
    constexpr double kSameDirection = 1e-9;
    const Vec3 axis = nominal_pose(machine_, q_, 0.0).rotation.col(2);
    return angle_between(axis, to_axis.normalized()) > kSameDirection;
  }

  // `wanted`: rotary positions that the block names; the great circle must lead there.
  void move_on_great_circle(const TipCurve& tip, const Vec3& to_axis, const AxisPositions* wanted,
                            const Manner& manner) {
    auto motion = vector_motion(machine_, q_, to_axis, tip, tip_frame());
    if (!motion) {
      fail(motion.error().front());
      return;
    }
    for (const AxisLetter letter : kRotaryAxes) {
      constexpr double kSameAngle = 1e-7;  // rad: angles are written to 1e-6 deg at best
      if (wanted == nullptr || std::abs((*wanted)[letter] - motion->end[letter]) < kSameAngle)
        continue;
      fail(fmt::format("the great circle brings {} to {:.4f} deg, the block wants {:.4f}",
                       to_char(letter), motion->end[letter] * kDegPerRad,
                       (*wanted)[letter] * kDegPerRad),
           "give tool vectors instead of rotary positions, or move the rotary axes linearly "
           "(ORIAXES, PATHCTRL AXIS)");
      return;
    }
    travel(*std::move(motion), manner);
  }

  // Rotary positions for a tool axis in the table frame: the solution nearest to where the axes are.
  bool orient_to(const Vec3& tool_axis, const Vec3& tip, AxisPositions& rotary_end) {
    const auto solutions = inverse(machine_, {tip, tool_axis}, compensated_length_, q_);
    if (!solutions) {
      fail(solutions.error().front());
      return false;
    }
    rotary_end = solutions->front().axes;
    return true;
  }

  // A tilted plane without tool-centre-point control: where the block ends, the tip is where its words
  // say; all axes move linearly. A block of rotary words alone turns these and nothing else.
  void move_in_plane(const AxisTarget& target, const Manner& manner) {
    AxisPositions end = rotary_end(target);
    const bool has_linear_words = std::any_of(kLinearAxes.begin(), kLinearAxes.end(),
                                              [&](AxisLetter l) { return target[l].has_value(); });
    if (has_linear_words) {
      const Vec3 tip = table_from_words_.point(linear_words(target, tip_in_words()));
      end = place_tip(machine_, tip, compensated_length_, end);
    }
    travel(axes_motion(q_, end), manner);
  }

  // Without tool-centre-point control a word is an axis position; all axes move linearly.
  void move_words(const AxisTarget& target, const Manner& manner, const parser::ArcFeed* arc) {
    const Vec3 shift = axis_shift();
    const Vec3 start = linear_positions(q_) - shift;
    const Vec3 end = linear_words(target, start);
    travel(words_motion(q_, rotary_end(target), curve(arc, start, end), shift), manner);
  }

  static TipCurve curve(const parser::ArcFeed* arc, const Vec3& start, const Vec3& end) {
    return arc == nullptr ? TipCurve::line(start, end) : TipCurve::arc(*arc, start, end);
  }

  static Vec3 linear_words(const AxisTarget& target, const Vec3& otherwise) {
    Vec3 words = otherwise;
    for (const AxisLetter letter : kLinearAxes) {
      if (target[letter]) words[static_cast<Eigen::Index>(letter)] = *target[letter];
    }
    return words;
  }

  [[nodiscard]] AxisPositions rotary_end(const AxisTarget& target) const {
    AxisPositions end = q_;
    for (const AxisLetter letter : kRotaryAxes) {
      if (!target[letter]) continue;
      end[letter] = turn_to(*machine_.joint(letter), *target[letter], q_[letter],
                            rotary_paths_.at(static_cast<std::size_t>(letter) - 3));
    }
    return end;
  }

  [[nodiscard]] Vec3 tip_in_words() const {
    return table_from_words_.inverse().point(
        nominal_pose(machine_, q_, compensated_length_).translation);
  }

  [[nodiscard]] TipFrame tip_frame() const { return {table_from_words_, compensated_length_}; }

  bool know_offset() {
    if (!offset_known_) execute(parser::WorkOffsetChange{offset_number_});
    return problems_.empty();
  }

  void place_words() { table_from_words_ = Pose::translated(offset_) * plane_.value_or(Pose{}); }

  // What to add to X Y Z words to get axis positions: at rotary zero the tip is where the words say.
  [[nodiscard]] Vec3 axis_shift() const {
    const AxisPositions zero;
    return linear_positions(place_tip(machine_, offset_, compensated_length_, zero));
  }

  void rest(double seconds) {
    if (options_.sample_path) recorder_.rest(seconds);
  }

  void travel(BlockMotion motion, const Manner& manner) {
    // The end first: it is what the block says.
    if (!within_travel(motion.end)) return;
    const int parts = motion.least_parts();
    for (int i = 1; i < parts; ++i) {
      if (!within_travel(motion.at(static_cast<double>(i) / parts))) return;
    }
    BlockOrder order;
    order.block.kind = manner.kind;
    if (!set_feed(motion, manner, order.block)) return;
    q_ = motion.end;
    if (options_.watch) {
      options_.watch(motion, order.block);
      if (!options_.sample_path) return;
    }
    if (!options_.sample_path) {
      execution_.axes.push_back({place_.line, manner.kind, q_});
      return;
    }
    if (!options_.sink) execution_.axes.push_back({place_.line, manner.kind, q_});
    order.motion = std::move(motion);
    order.block.source_line = place_.line;
    order.block.spindle_on = spindle_on_;
    order.block.tool = tool_;
    order.has_tool = tool_ != 0;
    if (order.has_tool) {
      const ToolGeometry& tool = setup_.tools.at(tool_);
      order.tool_length = tool.length + tool.length_error;
      order.reach = tool.flute_length;
    }
    recorder_.travel(std::move(order));
  }

  bool set_feed(const BlockMotion& motion, const Manner& manner, PathBlock& block) {
    if (manner.kind == PathKind::rapid) return true;
    const parser::Feed& feed = manner.feed;
    if (feed.mode == parser::FeedMode::per_revolution && spindle_speed_ <= 0.0) {
      fail("feed per revolution while the spindle stands",
           "start the spindle with S and M3 or M4 before the move");
      return false;
    }
    block.feed = feed.mode == parser::FeedMode::per_revolution ? feed.value * spindle_speed_
                 : feed.mode == parser::FeedMode::inverse_time ? feed.value * motion.feed_length
                                                               : feed.value;
    if (motion.feed_length > 0.0 && !(block.feed > 0.0)) {
      fail(fmt::format("a feed move with feed {:g}", feed.value), "give a feed above zero");
      return false;
    }
    block.feed_duration =
        motion.feed_length > 0.0 ? motion.feed_length / block.feed * kSecondsPerMinute : 0.0;
    return true;
  }

  // --- checks ---------------------------------------------------------------------------------

  bool present(AxisLetter letter) {
    if (machine_.joint(letter) != nullptr) return true;
    fail(fmt::format("machine {} ({}) has no axis {}", machine_.name(), machine_.structure(),
                     to_char(letter)),
         "choose a machine with that axis, or post-process the program for this one");
    return false;
  }

  static bool within_turns(const AxisPositions& q) {
    return std::all_of(kRotaryAxes.begin(), kRotaryAxes.end(),
                       [&](AxisLetter letter) { return std::abs(q[letter]) <= kMostTurned; });
  }
  bool within_travel(const AxisPositions& q) {
    if (options_.check_travel ? kinematics::within_travel(machine_, q) : within_turns(q))
      return true;
    const auto violations = travel_violations(machine_, q);
    fail(fmt::format("over-travel: {}", fmt::join(violations, "; ")),
         "move the workpiece on the table, or choose a larger machine");
    return false;
  }

  void fail(const Diagnostic& diagnostic) { fail(diagnostic.message, diagnostic.hint); }
  void fail(std::string message, std::string hint) {
    note(problems_, error(std::move(message), std::move(hint)));
  }
  void warn(std::string message) { note(execution_.warnings, warning(std::move(message))); }
  void note(Diagnostics& list, Diagnostic diagnostic) const {
    if (place_.file) diagnostic.file = *place_.file;
    diagnostic.line = static_cast<int>(place_.line);
    diagnostic.column = static_cast<int>(place_.column);
    list.push_back(std::move(diagnostic));
  }

  const Machine& machine_;
  const Setup& setup_;
  ControllerOptions options_;
  std::map<int, Vec3> work_offsets_;  // of the setup, and as the program places them

  AxisPositions q_;  // where the axes are
  Vec3 offset_ = Vec3::Zero();
  int offset_number_ = 1;
  bool offset_known_ = false;
  std::optional<Pose> plane_{};  // program_from_plane
  Pose table_from_words_{};
  LengthCompensation compensation_ = LengthCompensation::off;
  double compensated_length_ = 0.0;
  parser::OrientationPath orientation_path_ = parser::OrientationPath::rotary_axes;
  std::array<parser::RotaryPath, 3> rotary_paths_{};  // A, B, C
  int tool_ = 0;
  bool spindle_on_ = false;
  double spindle_speed_ = 0.0;  // 1/min
  parser::SourcePlace place_{};

  PathRecorder recorder_;
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

#include "kinematics/controller/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "kinematics/controller/controller_state.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/rotary_axes.hpp"

namespace frustum::kinematics {
namespace {

using parser::AxisTarget;
using parser::Coordinates;
using parser::Motion;

constexpr int kJobOffsets = 6;  // G54 to G59

}  // namespace

class Controller::State {
 public:
  State(const Machine& machine, const Setup& setup, CommandSink sink, const CommandOptions& options)
      : machine_(machine),
        setup_(setup),
        sink_(std::move(sink)),
        options_(options),
        state_(machine, setup),
        q_(machine.home()) {}

  Diagnostics run(const Motion& motion) {
    place_ = motion.place;
    std::visit([this](const auto& command) { execute(command); }, motion.command);
    return std::exchange(problems_, {});
  }

  [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

 private:
  // --- commands -------------------------------------------------------------------------------

  // Modes, coolant, events.
  template <typename Command>
  void execute(const Command& command) {
    state_.follow(command);
  }
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
    warn("probe-meets-nothing"_id,
         move.must_meet ? "the probe meets nothing here, where a control would stop with an alarm: "
                          "it goes to the end of its move"
                        : "the probe meets nothing here: it goes to the end of its move");
    go(move.end, move.tool_axis, Coordinates::program, {PathKind::feed, move.feed}, nullptr);
  }
  void execute(const parser::HomeReturn& move) {
    if (move.point != 1) {
      fail("unknown-reference-point"_id,
           fmt::format("G30: the machine has no reference point {}", move.point),
           "store the point with G30.1 before, or give it in machine coordinates (G53)");
      return;
    }
    AxisPositions end = q_;
    const AxisPositions home = machine_.home();
    // G28 alone: those that there are.
    const bool all = std::ranges::all_of(move.axes, std::identity{});
    for (const AxisLetter letter : kAxisLetters) {
      if (!move.axes[static_cast<std::size_t>(letter)]) continue;
      if (all ? machine_.joint(letter) != nullptr : present(letter)) end[letter] = home[letter];
    }
    if (problems_.empty()) travel(axes_motion(q_, end), {PathKind::rapid});
  }
  void execute(const parser::ToolChange& change) {
    if (change.tool != 0 && !setup_.tools.contains(change.tool)) {
      fail("unknown-tool"_id, fmt::format("tool T{} is not defined", change.tool),
           fmt::format("add tool.{} to the job; a tool is never replaced by another", change.tool));
      return;
    }
    state_.follow(change);
    sink_(CommandedToolChange{});
  }
  void execute(const parser::CompensationChange& change) {
    if (!state_.length_of(change)) {
      const bool is_missing = change.offset_number == 0;
      fail(is_missing ? "tool-length-missing"_id : "unknown-tool-length"_id,
           is_missing
               ? std::string("tool length compensation without an H word")
               : fmt::format("H{}: there is no tool length of that number", change.offset_number),
           "H n takes the length of tool n of the job");
      return;
    }
    state_.follow(change);
    if (modes().compensates() && !change.length && change.offset_number != tool()) {
      warn("length-of-other-tool"_id,
           fmt::format("H{} takes the length of tool {}, but tool {} is in the spindle",
                       change.offset_number, change.offset_number, tool()));
    }
  }
  void execute(const parser::WorkOffsetChange& change) {
    if (known_offset(change.number)) state_.follow(change);
  }
  void execute(const parser::WorkOffsetSetting& setting) {
    if (!state_.placed(setting)) {
      const std::string name = parser::work_offset_name(setting.number);
      fail("unknown-work-offset"_id,
           fmt::format("the program places {} along some axes, and nothing gives the others", name),
           "give X, Y and Z in the setting");
      return;
    }
    state_.follow(setting);
  }
  void execute(const parser::AlignToPlane& /*align*/) {
    if (!modes().plane) {
      fail("no-tilted-plane"_id,
           "the tool is to be set perpendicular to a tilted plane, but none is active",
           "define the plane first, for example with G68.2");
      return;
    }
    if (!known_offset(modes().work_offset)) return;
    const Vec3 normal = state_.table_from_words().direction(Vec3::UnitZ());
    const Vec3 tip = state_.tip_at(q_);
    AxisPositions end = q_;
    if (!orient_to(normal, tip, end)) return;
    if (modes().tip_control()) {
      const Vec3 words = state_.table_from_words().inverse().point(tip);
      travel(tip_motion(machine_, q_, end, TipCurve::line(words, words), state_.tip_frame()),
             {PathKind::rapid});
    } else {
      travel(axes_motion(q_, with_linear_positions(end, linear_positions(q_))), {PathKind::rapid});
    }
  }
  void execute(const parser::Dwell& dwell) { sink_(CommandedRest{dwell.seconds}); }
  void execute(const parser::Stop& stop) {
    state_.follow(stop);
    if (stop.kind != parser::StopKind::optional_stop) sink_(CommandedRest{});
  }

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
    if (manner.kind == PathKind::feed && tool() == 0 && options_.feeds_need_tool) {
      fail("feed-without-tool"_id, "feed move without a tool in the spindle",
           "call a tool first, for example T1 M6");
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
    if (!known_offset(modes().work_offset)) return;
    const bool centre_point = modes().tip_control();
    if (tool_axis && !centre_point) {
      fail("vector-without-tip-control"_id,
           "tool vector words I J K without tool-centre-point control",
           "switch it on with G43.5 H or G43.4 H");
    } else if (centre_point || (modes().plane && arc != nullptr)) {
      move_tip(target, tool_axis, manner, arc);
    } else if (modes().plane) {
      move_in_plane(target, manner);
    } else {
      move_words(target, manner, arc);
    }
  }

  // Tool-centre-point control: tip as programmed, the rotary axes or the tool axis on their own
  // path.
  void move_tip(const AxisTarget& target, const std::optional<UnitVec3>& tool_axis,
                const Manner& manner, const parser::ArcFeed* arc) {
    const Vec3 start = state_.tip_in_words(q_);
    const Vec3 end = linear_words(target, start);
    const TipCurve tip = curve(arc, start, end);
    AxisPositions q_end = rotary_end(target);
    if (modes().orientation_path == parser::OrientationPath::great_circle) {
      const Vec3 axis = tool_axis ? state_.table_from_words().direction(*tool_axis)
                                  : Vec3(nominal_pose(machine_, q_end, 0.0).rotation.col(2));
      if (turns_tool(axis)) {
        move_on_great_circle(tip, axis, tool_axis ? nullptr : &q_end, manner);
        return;
      }
    }
    if (tool_axis && !orient_to(state_.table_from_words().direction(*tool_axis),
                                state_.table_from_words().point(end), q_end)) {
      return;
    }
    travel(tip_motion(machine_, q_, q_end, tip, state_.tip_frame()), manner);
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
    auto motion = vector_motion(machine_, q_, to_axis, tip, state_.tip_frame());
    if (!motion) {
      fail(motion.error().front());
      return;
    }
    for (const AxisLetter letter : kRotaryAxes) {
      constexpr double kSameAngle = 1e-7;  // rad: angles are written to 1e-6 deg at best
      if (wanted == nullptr || std::abs((*wanted)[letter] - motion->end()[letter]) < kSameAngle)
        continue;
      fail("off-great-circle"_id,
           fmt::format("the great circle brings {} to {:.4f} deg, the block wants {:.4f}",
                       to_char(letter), motion->end()[letter] * kDegPerRad,
                       (*wanted)[letter] * kDegPerRad),
           "give tool vectors instead of rotary positions, or move the rotary axes linearly "
           "(ORIAXES, PATHCTRL AXIS)");
      return;
    }
    travel(*std::move(motion), manner);
  }

  // Rotary positions for a tool axis in the table frame: the solution nearest to where the axes
  // are.
  bool orient_to(const Vec3& tool_axis, const Vec3& tip, AxisPositions& rotary_end) {
    const auto solutions = inverse(machine_, {tip, tool_axis}, state_.tool_length(), q_);
    if (!solutions) {
      fail(solutions.error().front());
      return false;
    }
    rotary_end = solutions->front().axes;
    return true;
  }

  // A tilted plane without tool-centre-point control: where the block ends, the tip is where its
  // words say; all axes move linearly. A block of rotary words alone turns these and nothing else.
  void move_in_plane(const AxisTarget& target, const Manner& manner) {
    AxisPositions end = rotary_end(target);
    const bool has_linear_words = std::any_of(kLinearAxes.begin(), kLinearAxes.end(),
                                              [&](AxisLetter l) { return target[l].has_value(); });
    if (has_linear_words) {
      const Vec3 tip =
          state_.table_from_words().point(linear_words(target, state_.tip_in_words(q_)));
      end = place_tip(machine_, tip, state_.tool_length(), end);
    }
    travel(axes_motion(q_, end), manner);
  }

  // Without tool-centre-point control a word is an axis position; all axes move linearly.
  void move_words(const AxisTarget& target, const Manner& manner, const parser::ArcFeed* arc) {
    const Vec3 shift = state_.axis_shift();
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
                            modes().rotary_path(letter));
    }
    return end;
  }

  void travel(BlockMotion motion, const Manner& manner) {
    // The end first: it is what the block says.
    if (!within_travel(motion.end())) return;
    const int parts = options_.check_travel ? motion.least_parts() : 1;
    for (int i = 1; i < parts; ++i) {
      if (!within_travel(motion.at(static_cast<double>(i) / parts))) return;
    }
    CommandedMove move{.motion = std::move(motion), .kind = manner.kind};
    if (!set_feed(manner, move)) return;
    q_ = move.motion.end();
    move.source_line = place_.line;
    move.source_file = place_.file;
    move.main_line = place_.main_line;
    move.spindle = modes().spindle_turns();
    move.tool = tool();
    sink_(std::move(move));
  }

  bool set_feed(const Manner& manner, CommandedMove& move) {
    if (manner.kind == PathKind::rapid) return true;
    const parser::Feed& feed = manner.feed;
    const double length = move.motion.feed_length();
    if (feed.mode == parser::FeedMode::per_revolution && modes().spindle_speed() <= 0.0) {
      fail("spindle-off"_id, "feed per revolution while the spindle is at rest",
           "start the spindle with S and M3 or M4 before the move");
      return false;
    }
    move.feed = feed.mode == parser::FeedMode::per_revolution ? feed.value * modes().spindle_speed()
                : feed.mode == parser::FeedMode::inverse_time ? feed.value * length
                                                              : feed.value;
    if (length > 0.0 && !(move.feed > 0.0)) {
      fail("feed-missing"_id, fmt::format("a feed move with feed {:g}", feed.value),
           "give a feed above zero");
      return false;
    }
    move.feed_duration = length > 0.0 ? length / move.feed * kSecondsPerMinute : 0.0;
    return true;
  }

  // --- checks ---------------------------------------------------------------------------------

  bool present(AxisLetter letter) {
    if (machine_.joint(letter) != nullptr) return true;
    fail("unknown-axis"_id,
         fmt::format("machine {} ({}) has no axis {}", machine_.name(), machine_.structure(),
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
    fail("axis-over-travel"_id, fmt::format("over-travel: {}", fmt::join(violations, "; ")),
         "move the workpiece on the table, or choose a larger machine");
    return false;
  }

  bool known_offset(int number) {
    if (state_.origin_of(number) != nullptr) return true;
    const std::string name = parser::work_offset_name(number);
    fail("unknown-work-offset"_id, fmt::format("work offset {} is not defined", name),
         number <= kJobOffsets ? fmt::format("add {} to [offsets] of the job", name)
                               : std::string("use G54 to G59, or place it with G10 L2 before"));
    return false;
  }

  void fail(DiagnosticId id, std::string message, std::string hint) {
    fail(error(id, std::move(message), std::move(hint)));
  }
  void fail(Diagnostic problem) { problems_.push_back(placed(std::move(problem))); }
  void warn(DiagnosticId id, std::string message) {
    warnings_.push_back(placed(warning(id, std::move(message))));
  }
  [[nodiscard]] Diagnostic placed(Diagnostic diagnostic) const {
    if (place_.file) diagnostic.file = *place_.file;
    diagnostic.line = static_cast<int>(place_.line);
    diagnostic.column = static_cast<int>(place_.column);
    return diagnostic;
  }

  [[nodiscard]] const ControllerModes& modes() const { return state_.modes(); }
  [[nodiscard]] int tool() const { return modes().tool.value_or(0); }

  const Machine& machine_;
  const Setup& setup_;
  CommandSink sink_;
  CommandOptions options_;
  ControllerState state_;
  AxisPositions q_;  // where the axes are
  parser::SourcePlace place_{};
  Diagnostics warnings_;
  Diagnostics problems_;  // of the motion at work
};

Controller::Controller(const Machine& machine, const Setup& setup, CommandSink sink,
                       const CommandOptions& options)
    : state_(std::make_unique<State>(machine, setup, std::move(sink), options)) {}
Controller::~Controller() = default;

Diagnostics Controller::command(const Motion& motion) { return state_->run(motion); }
const Diagnostics& Controller::warnings() const { return state_->warnings(); }

Result<CommandedProgram> command(const Machine& machine, const Setup& setup,
                                 std::span<const Motion> motions, const CommandOptions& options) {
  CommandedProgram program{.machine = std::make_shared<const Machine>(machine),
                           .start = machine.home()};
  const auto keep = [&](CommandedStep&& step) { program.steps.push_back(std::move(step)); };
  Controller controller(*program.machine, setup, keep, options);
  for (const Motion& motion : motions) {
    if (Diagnostics problems = controller.command(motion); !problems.empty()) return problems;
  }
  program.warnings = controller.warnings();
  return program;
}

}  // namespace frustum::kinematics

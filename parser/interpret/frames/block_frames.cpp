// What changes the meaning of coordinates: planes, tool length and tip, work offsets, tilted planes.
#include <fmt/format.h>

#include <array>

#include "core/units.hpp"
#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxOffsetNumber = 9999;
constexpr int kMaxPreset = 999;
constexpr int kMaxExtendedOffset = 300;
constexpr int kMaxEdge = 12;

// What a length word makes of the two switches; the offset number is the caller's.
Compensation compensation_of(LengthWord word, const Compensation& before) {
  switch (word) {
    case LengthWord::off:
      return {};
    case LengthWord::length:
      return {true, false, false, 0};
    case LengthWord::tool_centre_point:
      return {true, true, false, 0};
    case LengthWord::tool_vectors:
      return {true, true, true, 0};
    case LengthWord::length_only:
      return {true, before.tip, false, 0};
    case LengthWord::dynamic:
    case LengthWord::additional:
      return {true, before.tip, false, before.offset_number};
    case LengthWord::length_only_off:
      return {false, before.tip, false, 0};
  }
  return before;
}

// What the machine is told: guiding the tip begins when the length is known.
CompensationChange told(const Compensation& compensation) {
  return {compensation.length ? compensation.mode() : LengthCompensation::off,
          compensation.tool_vectors && compensation.length, compensation.offset_number,
          compensation.length && compensation.tool_offset
              ? std::optional(compensation.tool_offset->at(2))
              : std::nullopt};
}
bool same(const CompensationChange& a, const CompensationChange& b) {
  return a.mode == b.mode && a.tool_vectors == b.tool_vectors &&
         a.offset_number == b.offset_number && a.length == b.length;
}

Mat3 turn_about(int axis, double angle) { return rotation_about(Vec3::Unit(axis), angle); }

// The order of the axes that a swivel mode names: three pairs of bits, 1 X, 2 Y, 3 Z, the first
// axis lowest; 57 is X Y Z. Empty for the modes that do not turn axis by axis.
std::optional<std::array<int, 3>> axis_sequence(int mode) {
  std::array<int, 3> axes{};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes.at(i) = ((mode >> (2 * static_cast<int>(i))) & 3) - 1;
    if (axes.at(i) < 0) return std::nullopt;
  }
  if (axes[0] == axes[1] || axes[1] == axes[2] || (mode >> 6) != 0) return std::nullopt;
  return axes;
}

// The turn of a swivel mode: axis by axis, or by solid angles: about Z, then the new Y.
std::optional<Mat3> swivelled(int mode, const Vec3& angles) {
  constexpr int kSolidAngles = 64;
  if ((mode & 192) == kSolidAngles)
    return Mat3(turn_about(2, angles[0]) * turn_about(1, angles[1]));
  const auto axes = axis_sequence(mode);
  if (!axes) return std::nullopt;
  Mat3 rotation = Mat3::Identity();
  for (std::size_t i = 0; i < axes->size(); ++i) {
    rotation = rotation * turn_about(axes->at(i), angles[static_cast<Eigen::Index>(i)]);
  }
  return rotation;
}

}  // namespace

bool BlockExecutor::guides_tip(const BlockWords& words) const {
  const Code* length = words[CodeGroup::length_compensation].code;
  const bool tip =
      length == nullptr
          ? state_.compensation.tip
          : compensation_of(static_cast<LengthWord>(length->value), state_.compensation).tip;
  return words.value_or(CodeGroup::tool_tip, tip ? TipWord::on : TipWord::off) == TipWord::on;
}

Result<Compensation> BlockExecutor::compensation_after(const BlockWords& words) const {
  Compensation next = state_.compensation;
  const GivenCode& length = words[CodeGroup::length_compensation];
  if (length.code != nullptr) {
    next = compensation_of(static_cast<LengthWord>(length.code->value), next);
    if (words.has('H')) {
      const auto number = whole(words, 'H', 1, kMaxOffsetNumber);
      if (!number) return number.error();
      next.offset_number = *number;
    } else if (rules_.dialect != Dialect::fanuc && next.length && length.code->arguments.has('H') &&
               length.code->value != static_cast<std::uint8_t>(LengthWord::additional)) {
      next.offset_number = state_.tool;
    }
    if (next.length) {
      auto offset = tool_offset_of(words, next);
      if (!offset) return offset.error();
      next.tool_offset = *offset;
    }
  }
  if (rules_.tool_brings_length && words.has(CodeGroup::tool_change)) next.length = true;
  if (words.has('D') && rules_.always_claimed.has('D')) {
    const auto edge = whole(words, 'D', 0, kMaxEdge);
    if (!edge) return edge.error();
    if (*edge > 1) {
      return fail(words['D'].column, "not-simulated"_id,
                  fmt::format("{} is not simulated", words.text_of('D')),
                  "tools have one edge here: D1, or D0 for no length");
    }
    next.length = *edge == 1;
  }
  if (rules_.tool_brings_length) {
    next.length = next.length && state_.tool != 0;
    next.offset_number = next.length ? state_.tool : 0;
  }
  next.tip =
      words.value_or(CodeGroup::tool_tip, next.tip ? TipWord::on : TipWord::off) == TipWord::on;
  return next;
}

BlockExecutor::Outcome BlockExecutor::change_compensation(const BlockWords& words,
                                                          const Compensation& next) {
  const ModalState before = state_;
  const AxisTarget axes = axis_positions();
  if (next.tip && next.tool_offset) {
    for (std::size_t i = 0; i < kAxisLetters.size(); ++i) {
      if (i == 2 || next.tool_offset->at(i) == 0.0) continue;
      const GivenCode& length = words[CodeGroup::length_compensation];
      const GivenCode& cause = length.code != nullptr ? length : words[CodeGroup::tool_tip];
      return fail(cause.column, "tool-offset-across"_id,
                  fmt::format("the tool-tip control with a tool offset along {}",
                              to_char(kAxisLetters.at(i))),
                  "it knows the tool's length (Z) alone");
    }
  }
  const CompensationChange told_before = told(before.compensation);
  const CompensationChange told_after = told(next);
  const bool tip_before = told_before.mode == LengthCompensation::tool_centre_point;
  const bool tip_after = told_after.mode == LengthCompensation::tool_centre_point;
  if (!next.tip) state_.tool_axis.reset();
  state_.compensation = next;
  place_datum(state_.datum);
  const bool same_tool = told_before.offset_number == told_after.offset_number &&
                         told_before.length == told_after.length;
  if (tip_before != tip_after || (tip_after && !same_tool)) {
    forget(kLinearWords, PositionLoss::length_compensation);
  } else {
    follow_datum(before, axes, PositionLoss::length_compensation);
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_compensation(const BlockWords& words) {
  const auto next = compensation_after(words);
  if (!next) return next.error();
  const CompensationChange before = told(state_.compensation);
  const CompensationChange after = told(*next);
  if (!(*next == state_.compensation)) {
    if (auto done = change_compensation(words, *next); !done) return done;
  }

  const GivenCode& length = words[CodeGroup::length_compensation];
  const GivenCode& tip = words[CodeGroup::tool_tip];
  const GivenCode& tool = words[CodeGroup::tool_change];
  const GivenCode& cause = length.code != nullptr ? length : tip.code != nullptr ? tip : tool;
  if (length.code != nullptr || !same(before, after)) {
    emit(cause.code != nullptr ? cause.column : words['D'].column, after);
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_work_offset(const BlockWords& words) {
  const GivenCode& offset = words[CodeGroup::work_offset];
  if (offset.code == nullptr) return Done{};
  int number = offset.code->value;
  if (!offset.code->arguments.empty()) {
    const bool extended = number == kExtendedWorkOffset;
    if (!words.has('P')) {
      return fail(offset.column, "word-missing"_id, offset.code->name() + " without a number",
                  extended ? "give P1 for the first of the further work offsets" : "give Q339=1");
    }
    const auto given =
        extended ? whole(words, 'P', 1, kMaxExtendedOffset) : whole(words, 'P', 0, kMaxPreset);
    if (!given) return given.error();
    number = *given + (extended ? kExtendedWorkOffset : 0);
  }
  return select_work_offset(number, offset.column);
}

Vec3 BlockExecutor::vector_of(const BlockWords& words, std::string_view letters) const {
  return {words[letters[0]].value, words[letters[1]].value, words[letters[2]].value};
}

// What a tilted plane is given in: the offset's coordinates, or, on top of the last plane, its words.
Result<Pose> BlockExecutor::plane_below(const BlockWords& words) const {
  if (!words.has(kSwivelOnTop)) return Pose{Mat3::Identity(), Vec3::Zero()};
  const ProgramFrame& frame = state_.program_frame;
  if (frame.scale != 1.0 || frame.linear.determinant() < 0.0) {
    return fail(words[kSwivelOnTop].column, "plane-frame"_id,
                "a swivel on top of a scaled or mirrored frame",
                "end SCALE and MIRROR before, by TRANS alone");
  }
  const Pose within{frame.linear, frame.origin};
  return state_.tilted ? state_.tilt * within : within;
}

BlockExecutor::Outcome BlockExecutor::set_tilted_plane(const BlockWords& words) {
  const GivenCode& tilt = words[CodeGroup::tilted_plane];
  if (tilt.code == nullptr) return Done{};
  const auto kind = static_cast<TiltWord>(tilt.code->value);
  if (kind == TiltWord::turn) return turn_words(words);
  if (kind == TiltWord::feature || kind == TiltWord::feature_within) return set_feature(words);
  if (kind >= TiltWord::spatial) return set_plane(words);
  if (kind == TiltWord::off) {
    state_.feature.reset();
    if (state_.frame_below) state_.programmed_frame = *state_.frame_below;
    state_.frame_below.reset();
  }
  const bool ends_turn = rules_.dialect != Dialect::heidenhain;  // G69
  if (kind == TiltWord::off && ends_turn && state_.programmed_frame.turns()) {
    ProgrammedFrame straight = state_.programmed_frame;
    straight.turn = {};
    change_programmed_frame(straight);
    if (!state_.tilted) return Done{};
  }
  // A new plane begins without programmable frame; on top of the last one, it begins where its words are.
  const auto below = plane_below(words);
  if (!below) return below.error();
  if (rules_.planes_end_frames) set_program_frame({});
  Pose plane{Mat3::Identity(), Vec3::Zero()};
  if (kind != TiltWord::off) plane.translation = vector_of(words, "XYZ") * unit_scale();
  if (kind == TiltWord::swivel) {
    const auto mode = whole(words, 'Q', 0, 255);
    if (!mode) return mode.error();
    const auto rotation = swivelled(*mode, vector_of(words, "ABC") * kRadPerDeg);
    if (!rotation) {
      return fail(words['Q'].column, "not-simulated"_id,
                  fmt::format("swivel mode {} is not simulated", *mode),
                  "turn axis by axis, mode 57: X, then Y, then Z; or by solid angles, mode 64");
    }
    plane.rotation = *rotation;
    plane.translation += plane.rotation * (vector_of(words, "uvw") * unit_scale());
    plane = *below * plane;
  }
  const bool aligns = (words.has('d') && words['d'].value != 0.0) || words.has('m');
  if (kind != TiltWord::off || state_.tilted || aligns) {
    forget(kLinearWords, PositionLoss::tilted_plane);
  }
  state_.tilted = kind != TiltWord::off || aligns;
  state_.tilt = plane;
  if (state_.tilted) {
    emit(tilt.column, TiltedPlaneChange{plane});
  }
  if (aligns) {
    if (auto done = turn_to_plane(words); !done) return done;
  }
  if (kind == TiltWord::off) {
    state_.tilted = false;
    emit(tilt.column, TiltedPlaneChange{});
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::align(std::uint32_t column) {
  if (!state_.tilted) {
    return fail(column, "plane-missing"_id, "no tilted plane to align the tool with",
                "define it before, by G68.2");
  }
  emit(column, AlignToPlane{});
  forget(kAxisWords, PositionLoss::tilted_plane);
  state_.tool_axis.reset();
  return Done{};
}

// TURN and MOVE; STAY leaves the axes where they are. MOVE holds the tip, as tool-tip control does.
BlockExecutor::Outcome BlockExecutor::turn_to_plane(const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::tilted_plane].column;
  if (!words.has('m')) return words.has('d') ? align(column) : Outcome{Done{}};
  const Compensation before = state_.compensation;
  if (!before.length) {
    return fail(words['m'].column, "tool-missing"_id,
                "MOVE holds the tip of a tool, but no tool is called",
                "call a tool before, or use TURN");
  }
  const auto hold = [&](bool tip) -> Outcome {
    Compensation next = before;
    next.tip = before.tip || tip;
    if (next == state_.compensation) return Done{};
    if (auto done = change_compensation(words, next); !done) return done;
    emit(column, told(next));
    return Done{};
  };
  if (auto done = hold(true); !done) return done;
  if (auto done = align(column); !done) return done;
  return hold(false);
}

void BlockExecutor::set_paths(const BlockWords& words) {
  const GivenCode& orientation = words[CodeGroup::orientation_path];
  if (const GivenCode& reference = words[CodeGroup::orientation_reference];
      reference.code != nullptr) {
    state_.orientation_reference = static_cast<OrientationReference>(reference.code->value);
    emit(reference.column, Event{reference.code->name(), {}});
  }
  if (orientation.code != nullptr) {
    state_.orientation_path = static_cast<OrientationPath>(orientation.code->value);
    emit(orientation.column,
         OrientationPathChange{static_cast<OrientationPath>(orientation.code->value)});
  }
  const GivenCode& rotary = words[CodeGroup::rotary_path];
  if (rotary.code != nullptr) {
    state_.rotary_path = static_cast<RotaryPath>(rotary.code->value);
    state_.announced_rotary_paths.fill(state_.rotary_path);
    emit(rotary.column, RotaryPathChange{state_.rotary_path});
  }
}

BlockExecutor::Outcome BlockExecutor::set_frames(const BlockWords& words) {
  state_.plane = words.value_or(CodeGroup::plane, state_.plane);
  state_.distance = words.value_or(CodeGroup::distance, state_.distance);
  state_.retract_to_initial =
      words.value_or(CodeGroup::retract,
                     state_.retract_to_initial ? RetractWord::initial : RetractWord::level) ==
      RetractWord::initial;
  state_.arc_distance = words.value_or(CodeGroup::arc_distance, state_.arc_distance);
  if (auto done = set_radius_compensation(words); !done) return done;
  if (auto done = set_compensation(words); !done) return done;
  if (auto done = set_work_offset(words); !done) return done;
  if (auto done = set_mirror(words); !done) return done;
  if (auto done = set_scaling(words); !done) return done;
  if (auto done = change_program_frame(words); !done) return done;
  if (auto done = set_tilted_plane(words); !done) return done;
  set_polar_mode(words);
  set_paths(words);
  return set_hole_cycle(words);
}

}  // namespace frustum::parser

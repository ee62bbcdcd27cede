#include "parser/interpret/frames/tilted_plane.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>

#include "core/units.hpp"
#include "parser/interpret/frames/feature_plane.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/frames/klartext_plane.hpp"
#include "parser/interpret/frames/programmable_frame.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

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

// What a tilted plane is given in: the offset's coordinates, or, on top of the last plane, its
// words.
Result<Pose> plane_below(const InterpreterState& state, const BlockWords& words) {
  if (!words.has(kSwivelOnTop)) return Pose{Mat3::Identity(), Vec3::Zero()};
  const ProgramFrame& frame = state.modes.program_frame;
  if (frame.scale != 1.0 || frame.linear.determinant() < 0.0) {
    return fail(state, words[kSwivelOnTop].column, "plane-frame"_id,
                "a swivel on top of a scaled or mirrored frame",
                "end SCALE and MIRROR before, by TRANS alone");
  }
  const Pose within{frame.linear, frame.origin};
  return state.modes.tilted ? state.modes.tilt * within : within;
}

}  // namespace

Outcome set_tilted_plane(InterpreterState& state, const BlockWords& words) {
  const GivenCode& tilt = words[CodeGroup::tilted_plane];
  if (tilt.code == nullptr) return Done{};
  const auto kind = static_cast<TiltWord>(tilt.code->value);
  if (kind != TiltWord::off && state.modes.tool_lengthening != 0.0) {
    return fail(state, tilt.column, "not-supported"_id,
                "DL of TOOL CALL in a tilted plane is not simulated",
                "give the tool's true length in the job");
  }
  if (kind == TiltWord::turn) return turn_words(state, words);
  if (kind == TiltWord::feature || kind == TiltWord::feature_within)
    return set_feature(state, words);
  if (kind >= TiltWord::spatial) return set_plane(state, words);
  if (kind == TiltWord::off) {
    state.modes.feature.reset();
    if (state.modes.frame_below) state.modes.programmed_frame = *state.modes.frame_below;
    state.modes.frame_below.reset();
  }
  const bool ends_turn = state.rules.dialect != Dialect::heidenhain;  // G69
  if (kind == TiltWord::off && ends_turn && state.modes.programmed_frame.turns()) {
    ProgrammedFrame straight = state.modes.programmed_frame;
    straight.turn = {};
    change_programmed_frame(state, straight);
    if (!state.modes.tilted) return Done{};
  }
  // A new plane begins without programmable frame; on top of the last one, it begins where its
  // words are.
  const auto below = plane_below(state, words);
  if (!below) return below.error();
  if (state.rules.planes_end_frames) set_program_frame(state, {});
  Pose plane{Mat3::Identity(), Vec3::Zero()};
  if (kind != TiltWord::off) plane.translation = lengths_of(state, words, "XYZ");
  if (kind == TiltWord::swivel) {
    const auto mode = whole(state, words, 'Q', 0, 255);
    if (!mode) return mode.error();
    const auto rotation = swivelled(*mode, vector_of(words, "ABC") * kRadPerDeg);
    if (!rotation) {
      return fail(state, words['Q'].column, "not-simulated"_id,
                  fmt::format("swivel mode {} is not simulated", *mode),
                  "turn axis by axis, mode 57: X, then Y, then Z; or by solid angles, mode 64");
    }
    plane.rotation = *rotation;
    plane.translation += plane.rotation * (lengths_of(state, words, "uvw"));
    plane = *below * plane;
  }
  const bool aligns = (words.has('d') && words['d'].value != 0.0) || words.has('m');
  if (kind != TiltWord::off || state.modes.tilted || aligns) {
    forget(state, kLinearWords, PositionLoss::tilted_plane);
  }
  state.modes.tilted = kind != TiltWord::off || aligns;
  state.modes.tilt = plane;
  if (state.modes.tilted) {
    emit(state, tilt.column, TiltedPlaneChange{plane});
  }
  if (aligns) {
    if (auto done = turn_to_plane(state, words); !done) return done;
  }
  if (kind == TiltWord::off) {
    state.modes.tilted = false;
    emit(state, tilt.column, TiltedPlaneChange{});
  }
  return Done{};
}

Outcome align(InterpreterState& state, std::uint32_t column) {
  if (!state.modes.tilted) {
    return fail(state, column, "plane-missing"_id, "no tilted plane to align the tool with",
                "define it before, by G68.2");
  }
  emit(state, column, AlignToPlane{});
  forget(state, kAxisWords, PositionLoss::tilted_plane);
  state.modes.tool_axis.reset();
  return Done{};
}

Outcome turn_to_plane(InterpreterState& state, const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::tilted_plane].column;
  if (!words.has('m')) return words.has('d') ? align(state, column) : Outcome{Done{}};
  const Compensation before = state.modes.compensation;
  if (!before.length) {
    return fail(state, words['m'].column, "tool-missing"_id,
                "MOVE holds the tip of a tool, but no tool is called",
                "call a tool before, or use TURN");
  }
  const auto hold = [&](bool tip) -> Outcome {
    Compensation next = before;
    next.tip = before.tip || tip;
    if (next == state.modes.compensation) return Done{};
    if (auto done = change_compensation(state, words, next); !done) return done;
    emit(state, column, compensation_change(next));
    return Done{};
  };
  if (auto done = hold(true); !done) return done;
  if (auto done = align(state, column); !done) return done;
  return hold(false);
}

Outcome tilt(InterpreterState& state, const GivenCode& code, const Pose& plane, bool within) {
  if (!within && state.modes.frame_below) state.modes.programmed_frame = *state.modes.frame_below;
  if (state.modes.programmed_frame.is_mirrored() || state.modes.programmed_frame.scale != 1.0) {
    return fail(state, code.column, "plane-frame"_id,
                fmt::format("{} while the words are mirrored or scaled", code.code->name()),
                "end that before, by G50 and G50.1");
  }
  const Pose outer = within && state.modes.tilted ? state.modes.tilt : Pose{};
  const Pose words =
      state.modes.programmed_frame.turn * Pose::translated(state.modes.programmed_frame.shift);
  if (!state.modes.frame_below) state.modes.frame_below = state.modes.programmed_frame;
  state.modes.programmed_frame =
      ProgrammedFrame{.rotary_shift = state.modes.programmed_frame.rotary_shift};
  forget(state, kLinearWords, PositionLoss::tilted_plane);
  state.modes.tilted = true;
  state.modes.tilt = outer * words * plane;
  emit(state, code.column, TiltedPlaneChange{state.modes.tilt});
  return Done{};
}

}  // namespace frustum::parser

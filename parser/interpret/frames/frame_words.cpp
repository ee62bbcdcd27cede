#include "parser/interpret/frames/frame_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/frames/feature_plane.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// What the control takes.
constexpr double kLeastScale = 1e-5;

constexpr double kMostScale = 1e4;

// G92.1 X0 Y0: these axes have no shift any more.
Outcome preset_axes(InterpreterState& state, const BlockWords& words) {
  ProgrammedFrame next = state.modes.programmed_frame;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    if (words[letter].value != 0.0) {
      return fail(state, words[letter].column, "out-of-range"_id,
                  fmt::format("{} of {} is not zero", words.text_of(letter),
                              words[CodeGroup::non_modal].code->name()),
                  fmt::format("write {}0, which ends the shift of the axis", letter));
    }
    const auto slot = static_cast<std::size_t>(axis);
    (is_rotary(axis) ? next.rotary_shift.at(slot - 3)
                     : next.shift[static_cast<Eigen::Index>(slot)]) = 0.0;
    state.modes.local_shift.at(slot) = 0.0;
    state.data.shift.at(slot) = 0.0;
  }
  change_programmed_frame(state, next);
  return Done{};
}

// Of Klartext the datum shift of cycle 7 is one: a shift of zero in a tilted plane ends the one
// from before the plane too, which then does not come back with the end of the plane.
void reset_shift_below(InterpreterState& state, const BlockWords& words) {
  auto& below = state.modes.frame_below;
  if (state.rules.dialect != Dialect::heidenhain || !below) return;
  bool any = false;
  for (const AxisLetter axis : kAxisLetters) {
    const GivenWord& word = words[to_char(axis)];
    if (!words.has(to_char(axis)) || word.value != 0.0 || word.measure == Measure::incremental) {
      continue;
    }
    const auto slot = static_cast<std::size_t>(axis);
    double& shift = is_rotary(axis) ? below->rotary_shift.at(slot - 3)
                                    : below->shift[static_cast<Eigen::Index>(slot)];
    any = any || shift != 0.0;
    shift = 0.0;
  }
  if (!any) return;
  assume(state, words[CodeGroup::non_modal].column, "datum-shift-in-plane",
         "a datum shift of zero within a tilted plane ends the shift from before the plane; the "
         "plane stays where it is until it ends");
}

// What changes the words of Fanuc, and the word that ends it.
struct FrameInForce {
  bool (*on)(const ProgrammedFrame& frame);
  CodeGroup group;
  std::uint8_t off;
  std::string_view name;
  std::string_view end;
};
constexpr std::array kFramesInForce{
    FrameInForce{[](const ProgrammedFrame& frame) { return frame.turns(); },
                 CodeGroup::tilted_plane, static_cast<std::uint8_t>(TiltWord::off),
                 "a rotation by G68", "G69"},
    FrameInForce{[](const ProgrammedFrame& frame) { return frame.scale != 1.0; },
                 CodeGroup::scaling, static_cast<std::uint8_t>(ScalingWord::off),
                 "a scaling by G51", "G50"},
    FrameInForce{[](const ProgrammedFrame& frame) { return frame.is_mirrored(); },
                 CodeGroup::mirror, static_cast<std::uint8_t>(MirrorWord::off),
                 "a mirror image by G51.1", "G50.1"},
};
// G27 to G30, G52, G53, G92, which have no place in it; beside G54 to G59, and G17 to G19 in a
// rotation.
constexpr std::array kNotInFrames{
    NonModal::home,  NonModal::second_home,         NonModal::check_home,    NonModal::from_home,
    NonModal::shift, NonModal::machine_coordinates, NonModal::shift_to_place};

}  // namespace

Outcome check_frame_words(const InterpreterState& state, const BlockWords& words) {
  const ProgrammedFrame& frame = state.modes.programmed_frame;
  if (state.rules.dialect != Dialect::fanuc || frame.is_identity()) return Done{};
  const auto non_modal = words.value_or(CodeGroup::non_modal, NonModal::none);
  const bool misplaced = std::ranges::find(kNotInFrames, non_modal) != kNotInFrames.end();
  for (const FrameInForce& in_force : kFramesInForce) {
    const Code* own = words[in_force.group].code;
    if (!in_force.on(frame) || (own != nullptr && own->value == in_force.off)) continue;
    const bool turned = in_force.group == CodeGroup::tilted_plane;
    const GivenCode& code = misplaced                               ? words[CodeGroup::non_modal]
                            : words.has(CodeGroup::work_offset)     ? words[CodeGroup::work_offset]
                            : turned && words.has(CodeGroup::plane) ? words[CodeGroup::plane]
                                                                    : GivenCode{};
    if (code.code == nullptr) continue;
    return fail(state, code.column, "frame-nested"_id,
                fmt::format("{} within {}", code.code->name(), in_force.name),
                fmt::format("end it before by {}, and begin it again afterwards", in_force.end));
  }
  return Done{};
}

void change_programmed_frame(InterpreterState& state, const ProgrammedFrame& next) {
  const AxisTarget words =
      next.to_words(state.modes.programmed_frame.from_words(state.position.target()));
  for (const AxisLetter axis : kAxisLetters) {
    if (words[axis]) {
      state.position.set(axis, *words[axis]);
    } else {
      const auto standing = state.position.standing(axis);
      state.position.forget(axis, PositionLoss::turned_frame, state.at_work.block->line);
      if (standing) state.position.stand(axis, *standing);
    }
  }
  state.modes.programmed_frame = next;
  lose_pole(state);
}

Outcome shift_words(InterpreterState& state, const BlockWords& words, NonModal how) {
  const GivenCode& code = words[CodeGroup::non_modal];
  ProgrammedFrame next = state.modes.programmed_frame;
  const auto clear = [&] {
    next.shift.setZero();
    next.rotary_shift = {};
    state.modes.local_shift = {};
  };
  switch (how) {
    case NonModal::shift_off:
      if (!(words.given() & kAxisWords).empty()) return preset_axes(state, words);
      clear();
      state.data.shift = {};
      state.data.shift_counts = false;
      break;
    case NonModal::shift_suspend:
      clear();
      state.data.shift_counts = false;
      break;
    case NonModal::shift_resume:
      for (std::size_t i = 0; i < 3; ++i) {
        next.shift[static_cast<Eigen::Index>(i)] = state.data.shift.at(i);
        next.rotary_shift.at(i) = state.data.shift.at(3 + i);
      }
      state.data.shift_counts = true;
      break;
    default:
      if (state.rules.dialect == Dialect::heidenhain &&
          (next.turns() || next.is_mirrored() || next.scale != 1.0)) {
        return fail(state, code.column, "frame-nested"_id,
                    "a datum shift within a rotation, mirror image or scaling",
                    "end them (CYCL DEF 10.1 ROT+0, 8.1, 11.1 SCL 1), shift, and begin them again");
      }
      if ((words.given() & kAxisWords).empty()) {
        return fail(state, code.column, "axes-missing"_id, code.code->name() + " names no axis",
                    fmt::format("give the axes to shift, for example {} X0", code.code->name()));
      }
      for (const AxisLetter axis : kAxisLetters) {
        const char letter = to_char(axis);
        if (!words.has(letter)) continue;
        const double value = scaled(state, axis, words[letter].value);
        const auto slot = static_cast<std::size_t>(axis);
        double& shift = is_rotary(axis) ? next.rotary_shift.at(slot - 3)
                                        : next.shift[static_cast<Eigen::Index>(slot)];
        if (how == NonModal::shift && state.rules.local_shift_is_apart) {
          shift += value - std::exchange(state.modes.local_shift.at(slot), value);
          continue;
        }
        if (how == NonModal::shift) {
          shift = value + (words[letter].measure == Measure::incremental ? shift : 0.0);
          continue;
        }
        if (state.rules.starts_with_rapid && state.position.never_known(axis)) {
          assume(state, words[letter].column, "start",
                 fmt::format("the program begins where {} says, in the work offset in force",
                             code.code->name()));
          state.position.set(axis, value - std::exchange(shift, 0.0));
          continue;
        }
        if (!state.position[axis]) {
          return fail(state, words[letter].column, state.position.unknown_id(axis),
                      fmt::format("{} says where {} is, but {}", code.code->name(), letter,
                                  state.position.why_unknown(axis)),
                      fmt::format("move {} with G0 or G1 before", letter));
        }
        shift += *state.position[axis] - value;
        state.modes.local_shift.at(slot) = 0.0;
      }
      reset_shift_below(state, words);
      for (std::size_t i = 0; i < 3; ++i) {
        state.data.shift.at(i) = next.shift[static_cast<Eigen::Index>(i)];
        state.data.shift.at(3 + i) = next.rotary_shift.at(i);
      }
      state.data.shift_counts = true;
  }
  change_programmed_frame(state, next);
  return Done{};
}

Outcome turn_words(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  if (!words.has('R')) {
    return fail(state, code.column, "word-missing"_id, code.code->name() + " without an angle",
                "give R in degrees");
  }
  if (!(words.given() & LetterSet("IJK")).empty()) return turn_in_space(state, words);
  if (state.rules.dialect == Dialect::heidenhain && state.modes.programmed_frame.is_mirrored()) {
    return fail(state, code.column, "frame-nested"_id, "a rotation within a mirror image",
                "end the mirror image by CYCL DEF 8.1, without axes");
  }
  const PlaneAxes axes = axes_of(state.modes.plane);
  ProgrammedFrame next = state.modes.programmed_frame;
  // Where the tool is, in words before the turn.
  const AxisTarget here = ProgrammedFrame{.turn = next.turn}.from_words(
      ProgrammedFrame{.shift = next.shift}.from_words(state.position.target()));
  Vec3 pivot = Vec3::Zero();
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (words.has(to_char(letter))) {
      pivot[axis] = scaled(state, letter, words[to_char(letter)].value) + next.shift[axis];
    } else if (here[letter]) {
      pivot[axis] = *here[letter];
    } else {
      return fail(state, code.column, state.position.unknown_id(letter),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              state.position.why_unknown(letter)),
                  fmt::format("give {} on this block", to_char(letter)));
    }
  }
  Mat3 rotation = rotation_about(Vec3::Unit(axes.w), words['R'].value * kRadPerDeg);
  const bool of_fanuc = state.rules.dialect == Dialect::fanuc;
  if (of_fanuc && state.modes.distance == DistanceMode::incremental && next.turns()) {
    assume(state, words['R'].column, "angle of G68",
           fmt::format("{} in G91 replaces the angle before, as parameter 5400#0 (RIN) = 0 has it",
                       words.text_of('R')));
  }
  const bool adds = !of_fanuc && state.modes.distance == DistanceMode::incremental;
  if (adds || words['R'].measure == Measure::incremental) {
    if (!next.keeps(state.modes.plane)) {
      return fail(state, words['R'].column, "frame-nested"_id,
                  fmt::format("{} in G91 goes on from a turn in another plane", words.text_of('R')),
                  "end that turn with G69 before");
    }
    rotation = rotation * next.turn.rotation;
  }
  next.turn = Pose{rotation, pivot - rotation * pivot};
  change_programmed_frame(state, next);
  return Done{};
}

Outcome set_scaling(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::scaling];
  if (code.code == nullptr) return Done{};
  ProgrammedFrame next = state.modes.programmed_frame;
  const bool klartext = state.rules.dialect == Dialect::heidenhain;
  if (next.turns()) {
    return fail(state, code.column, "frame-nested"_id,
                fmt::format("{} within a turned frame", code.code->name()),
                klartext ? "end the rotation before, by CYCL DEF 10.1 ROT+0, and begin it again"
                         : "scale first and turn then, and end them the other way round: G69, then "
                           "G50");
  }
  // Of Klartext an axis that is not named keeps its factor.
  const double kept = next.scale;
  next.scale = 1.0;
  next.scale_centre.setZero();
  change_programmed_frame(state, next);
  if (static_cast<ScalingWord>(code.code->value) == ScalingWord::off) return Done{};

  const auto factor = [&](char letter) {
    // A number without a point counts thousandths.
    return words[letter].value * (words[letter].decimal_point ? 1.0 : 1e-3);
  };
  const char given = words.first_of(LetterSet("PIJK"));
  if (given == 0) {
    return fail(state, code.column, "word-missing"_id, code.code->name() + " without a factor",
                "give P, for example P2. or P2000 for twice the size");
  }
  for (const char letter : {'I', 'J', 'K'}) {
    if (given == 'P' ? !words.has(letter) : words.has(letter) && factor(letter) == factor(given)) {
      continue;
    }
    const bool missing = !words.has(letter);
    if (klartext && missing && factor(given) == kept) continue;
    if (klartext) {
      return fail(state, words[missing ? given : letter].column, "scaling-uneven"_id,
                  fmt::format("{} scales one axis other than the rest",
                              words.text_of(missing ? given : letter)),
                  "circles would be none: give X, Y and Z one factor, or CYCL DEF 11.1 SCL 0.99");
    }
    return fail(state, words[missing ? given : letter].column, "scaling-uneven"_id,
                missing
                    ? fmt::format("{} scales without {}", code.code->name(), letter)
                    : fmt::format("{} scales one axis other than the rest", words.text_of(letter)),
                "circles would be none: give one factor by P, and mirror axes by G51.1");
  }
  next.scale = factor(given);
  if (!(next.scale > 0.0)) {
    return fail(state, words[given].column, "scaling-factor"_id,
                fmt::format("{} is not above zero", words.text_of(given)),
                fmt::format("give a factor above zero, and mirror axes by {}",
                            klartext ? "CYCL DEF 8" : "G51.1"));
  }
  if (!(next.scale >= kLeastScale && next.scale <= kMostScale)) {
    return fail(state, words[given].column, "scaling-factor"_id,
                fmt::format("{} is out of range", words.text_of(given)),
                "give a factor from 0.00001 to 10000");
  }
  if (klartext && given == 'P' && next.scale != 1.0) {
    assume(state, code.column, code.code->name(),
           "scales Z as well: MP7410 of the control says whether it does");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<Eigen::Index>(axis);
    if (words.has(to_char(axis))) {
      next.scale_centre[i] = scaled(state, axis, words[to_char(axis)].value) + next.shift[i];
    } else if (state.position[axis]) {
      next.scale_centre[i] = *state.position[axis] + next.shift[i];
    } else {
      return fail(state, code.column, state.position.unknown_id(axis),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              state.position.why_unknown(axis)),
                  fmt::format("give {} on this block", to_char(axis)));
    }
  }
  change_programmed_frame(state, next);
  return Done{};
}

Outcome set_mirror(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::mirror];
  if (code.code == nullptr) return Done{};
  ProgrammedFrame next = state.modes.programmed_frame;
  if (next.turns() || next.scale != 1.0) {
    return fail(
        state, code.column, "frame-nested"_id,
        fmt::format("{} within a turned or scaled frame", code.code->name()),
        state.rules.dialect == Dialect::heidenhain
            ? "end them before (CYCL DEF 10.1 ROT+0, 11.1 SCL 1), mirror, and begin them again"
            : "mirror first, then scale, then turn, and end them the other way round: G69, "
              "G50, G50.1");
  }
  const bool on = static_cast<MirrorWord>(code.code->value) == MirrorWord::on;
  const bool all = (words.given() & kLinearWords).empty();
  // Of Klartext the axes are those of the last definition.
  if (state.rules.dialect == Dialect::heidenhain) next.mirrors = {};
  if (on && all) {
    return fail(state, code.column, "axes-missing"_id, code.code->name() + " names no axis",
                "give where the axis is mirrored, for example G51.1 X0");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<std::size_t>(axis);
    const bool named = words.has(to_char(axis));
    if (!on && (named || all)) next.mirrors.at(i).reset();
    if (!on || !named) continue;
    next.mirrors.at(i) = scaled(state, axis, words[to_char(axis)].value) +
                         next.shift[static_cast<Eigen::Index>(axis)];
  }
  change_programmed_frame(state, next);
  return Done{};
}

Outcome check_programmed_frame(const InterpreterState& state, const Movement& movement) {
  if (state.modes.programmed_frame.is_mirrored() && state.modes.compensation.tip) {
    return fail(state, movement.column, "frame-mirrored"_id,
                "a move with tool-tip control in a mirrored frame",
                "mirror the program before it is written, or switch the control off");
  }
  if (!state.modes.programmed_frame.turns() && !state.modes.offset_frame.turns()) return Done{};
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const bool mixed =
        state.modes.programmed_frame.blends(axis) || state.modes.offset_frame.mixes(axis);
    if (state.position[axis] || !mixed) continue;
    return fail(state, movement.column, state.position.unknown_id(axis),
                fmt::format("a move in a turned frame, but {}", state.position.why_unknown(axis)),
                fmt::format("program {} once, in absolute coordinates, after the frame is turned",
                            to_char(axis)));
  }
  if (is_spline(movement.motion) && !(state.modes.programmed_frame.keeps(state.modes.plane) &&
                                      state.modes.offset_frame.keeps(state.modes.plane))) {
    return fail(state, movement.column, "arc-plane-turned"_id,
                "a spline in a plane that the frame turns",
                "write it as straight moves, or turn the frame about the normal of the plane");
  }
  return Done{};
}

}  // namespace frustum::parser

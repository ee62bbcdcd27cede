// The words that shift, turn, scale and mirror the frame of the words that follow: G92, G52, G68,
// G51, G51.1.
#include <fmt/format.h>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

// What the control takes.
constexpr double kLeastScale = 1e-5;
constexpr double kMostScale = 1e4;

}  // namespace

// The tool stays where it is; its coordinates change.
void BlockExecutor::change_programmed_frame(const ProgrammedFrame& next) {
  const AxisTarget words = next.to_words(state_.programmed_frame.from_words(position_.target()));
  for (const AxisLetter axis : kAxisLetters) {
    if (words[axis]) {
      position_.set(axis, *words[axis]);
    } else {
      position_.forget(axis, PositionLoss::turned_frame, block_->line);
    }
  }
  state_.programmed_frame = next;
  lose_pole();
}

BlockExecutor::Outcome BlockExecutor::shift_words(const BlockWords& words, NonModal how) {
  const GivenCode& code = words[CodeGroup::non_modal];
  ProgrammedFrame next = state_.programmed_frame;
  const auto clear = [&] {
    next.shift.setZero();
    next.rotary_shift = {};
  };
  switch (how) {
    case NonModal::shift_off:
      clear();
      data_.shift = {};
      data_.shift_counts = false;
      break;
    case NonModal::shift_suspend:
      clear();
      data_.shift_counts = false;
      break;
    case NonModal::shift_resume:
      for (std::size_t i = 0; i < 3; ++i) {
        next.shift[static_cast<Eigen::Index>(i)] = data_.shift.at(i);
        next.rotary_shift.at(i) = data_.shift.at(3 + i);
      }
      data_.shift_counts = true;
      break;
    default:
      if (rules_.dialect == Dialect::heidenhain &&
          (next.turns() || next.is_mirrored() || next.scale != 1.0)) {
        return fail(code.column, "frame-nested"_id,
                    "a datum shift within a rotation, mirror image or scaling",
                    "end them (CYCL DEF 10.1 ROT+0, 8.1, 11.1 SCL 1), shift, and begin them again");
      }
      if ((words.given() & kAxisWords).empty()) {
        return fail(code.column, "axes-missing"_id, code.code->name() + " names no axis",
                    fmt::format("give the axes to shift, for example {} X0", code.code->name()));
      }
      for (const AxisLetter axis : kAxisLetters) {
        const char letter = to_char(axis);
        if (!words.has(letter)) continue;
        const double value = scaled(axis, words[letter].value);
        const auto slot = static_cast<std::size_t>(axis);
        double& shift = is_rotary(axis) ? next.rotary_shift.at(slot - 3)
                                        : next.shift[static_cast<Eigen::Index>(slot)];
        if (how == NonModal::shift) {
          shift = value + (words[letter].measure == Measure::incremental ? shift : 0.0);
          continue;
        }
        if (!position_[axis]) {
          return fail(words[letter].column, position_.unknown_id(axis),
                      fmt::format("{} says where {} is, but {}", code.code->name(), letter,
                                  position_.why_unknown(axis)),
                      fmt::format("move {} with G0 or G1 before", letter));
        }
        shift += *position_[axis] - value;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        data_.shift.at(i) = next.shift[static_cast<Eigen::Index>(i)];
        data_.shift.at(3 + i) = next.rotary_shift.at(i);
      }
      data_.shift_counts = true;
  }
  change_programmed_frame(next);
  return Done{};
}

// G68: about the centre X Y (of the plane's axes) by R degrees.
BlockExecutor::Outcome BlockExecutor::turn_words(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  if (!words.has('R')) {
    return fail(code.column, "word-missing"_id, code.code->name() + " without an angle",
                "give R in degrees");
  }
  if (!(words.given() & LetterSet("IJK")).empty()) return turn_in_space(words);
  if (rules_.dialect == Dialect::heidenhain && state_.programmed_frame.is_mirrored()) {
    return fail(code.column, "frame-nested"_id, "a rotation within a mirror image",
                "end the mirror image by CYCL DEF 8.1, without axes");
  }
  const PlaneAxes axes = axes_of(state_.plane);
  ProgrammedFrame next = state_.programmed_frame;
  // Where the tool is, in words before the turn.
  const AxisTarget here = ProgrammedFrame{.turn = next.turn}.from_words(
      ProgrammedFrame{.shift = next.shift}.from_words(position_.target()));
  Vec3 pivot = Vec3::Zero();
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (words.has(to_char(letter))) {
      pivot[axis] = scaled(letter, words[to_char(letter)].value) + next.shift[axis];
    } else if (here[letter]) {
      pivot[axis] = *here[letter];
    } else {
      return fail(code.column, position_.unknown_id(letter),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              position_.why_unknown(letter)),
                  fmt::format("give {} on this block", to_char(letter)));
    }
  }
  Mat3 rotation = rotation_about(Vec3::Unit(axes.w), words['R'].value * kRadPerDeg);
  if (state_.distance == DistanceMode::incremental || words['R'].measure == Measure::incremental) {
    if (!next.keeps(state_.plane)) {
      return fail(words['R'].column, "frame-nested"_id,
                  fmt::format("{} in G91 goes on from a turn in another plane", words.text_of('R')),
                  "end that turn with G69 before");
    }
    rotation = rotation * next.turn.rotation;
  }
  next.turn = Pose{rotation, pivot - rotation * pivot};
  change_programmed_frame(next);
  return Done{};
}

// G51 X Y Z P: lengths times P about a centre.
BlockExecutor::Outcome BlockExecutor::set_scaling(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::scaling];
  if (code.code == nullptr) return Done{};
  ProgrammedFrame next = state_.programmed_frame;
  const bool klartext = rules_.dialect == Dialect::heidenhain;
  if (next.turns()) {
    return fail(code.column, "frame-nested"_id,
                fmt::format("{} within a turned frame", code.code->name()),
                klartext ? "end the rotation before, by CYCL DEF 10.1 ROT+0, and begin it again"
                         : "scale first and turn then, and end them the other way round: G69, then "
                           "G50");
  }
  // Of Klartext an axis that is not named keeps its factor.
  const double kept = next.scale;
  next.scale = 1.0;
  next.scale_centre.setZero();
  change_programmed_frame(next);
  if (static_cast<ScalingWord>(code.code->value) == ScalingWord::off) return Done{};

  const auto factor = [&](char letter) {
    // A number without a point counts thousandths.
    return words[letter].value * (words[letter].decimal_point ? 1.0 : 1e-3);
  };
  const char given = words.first_of(LetterSet("PIJK"));
  if (given == 0) {
    return fail(code.column, "word-missing"_id, code.code->name() + " without a factor",
                "give P, for example P2. or P2000 for twice the size");
  }
  for (const char letter : {'I', 'J', 'K'}) {
    if (given == 'P' ? !words.has(letter) : words.has(letter) && factor(letter) == factor(given)) {
      continue;
    }
    const bool missing = !words.has(letter);
    if (klartext && missing && factor(given) == kept) continue;
    if (klartext) {
      return fail(words[missing ? given : letter].column, "scaling-uneven"_id,
                  fmt::format("{} scales one axis other than the rest",
                              words.text_of(missing ? given : letter)),
                  "circles would be none: give X, Y and Z one factor, or CYCL DEF 11.1 SCL 0.99");
    }
    return fail(words[missing ? given : letter].column, "scaling-uneven"_id,
                missing
                    ? fmt::format("{} scales without {}", code.code->name(), letter)
                    : fmt::format("{} scales one axis other than the rest", words.text_of(letter)),
                "circles would be none: give one factor by P, and mirror axes by G51.1");
  }
  next.scale = factor(given);
  if (!(next.scale > 0.0)) {
    return fail(words[given].column, "scaling-factor"_id,
                fmt::format("{} is not above zero", words.text_of(given)),
                fmt::format("give a factor above zero, and mirror axes by {}",
                            klartext ? "CYCL DEF 8" : "G51.1"));
  }
  if (!(next.scale >= kLeastScale && next.scale <= kMostScale)) {
    return fail(words[given].column, "scaling-factor"_id,
                fmt::format("{} is out of range", words.text_of(given)),
                "give a factor from 0.00001 to 10000");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<Eigen::Index>(axis);
    if (words.has(to_char(axis))) {
      next.scale_centre[i] = scaled(axis, words[to_char(axis)].value) + next.shift[i];
    } else if (position_[axis]) {
      next.scale_centre[i] = *position_[axis] + next.shift[i];
    } else {
      return fail(code.column, position_.unknown_id(axis),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              position_.why_unknown(axis)),
                  fmt::format("give {} on this block", to_char(axis)));
    }
  }
  change_programmed_frame(next);
  return Done{};
}

// G51.1 X10: what is beyond X10 is on this side of it.
BlockExecutor::Outcome BlockExecutor::set_mirror(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::mirror];
  if (code.code == nullptr) return Done{};
  ProgrammedFrame next = state_.programmed_frame;
  if (next.turns() || next.scale != 1.0) {
    return fail(
        code.column, "frame-nested"_id,
        fmt::format("{} within a turned or scaled frame", code.code->name()),
        rules_.dialect == Dialect::heidenhain
            ? "end them before (CYCL DEF 10.1 ROT+0, 11.1 SCL 1), mirror, and begin them again"
            : "mirror first, then scale, then turn, and end them the other way round: G69, "
              "G50, G50.1");
  }
  const bool on = static_cast<MirrorWord>(code.code->value) == MirrorWord::on;
  const bool all = (words.given() & kLinearWords).empty();
  // Of Klartext the axes are those of the last definition.
  if (rules_.dialect == Dialect::heidenhain) next.mirrors = {};
  if (on && all) {
    return fail(code.column, "axes-missing"_id, code.code->name() + " names no axis",
                "give where the axis is mirrored, for example G51.1 X0");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<std::size_t>(axis);
    const bool named = words.has(to_char(axis));
    if (!on && (named || all)) next.mirrors.at(i).reset();
    if (!on || !named) continue;
    next.mirrors.at(i) =
        scaled(axis, words[to_char(axis)].value) + next.shift[static_cast<Eigen::Index>(axis)];
  }
  change_programmed_frame(next);
  return Done{};
}

// A turned frame mixes the axes, so that all of them have to be known before one of them moves.
BlockExecutor::Outcome BlockExecutor::check_programmed_frame(const Movement& movement) const {
  if (state_.programmed_frame.is_mirrored() && state_.compensation.tip) {
    return fail(movement.column, "frame-mirrored"_id,
                "a move with tool-tip control in a mirrored frame",
                "mirror the program before it is written, or switch the control off");
  }
  if (!state_.programmed_frame.turns() && !state_.offset_frame.turns()) return Done{};
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    if (position_[axis]) continue;
    return fail(movement.column, position_.unknown_id(axis),
                fmt::format("a move in a turned frame, but {}", position_.why_unknown(axis)),
                "program X, Y and Z once, in absolute coordinates, after the frame is turned");
  }
  const bool arc = is_arc_in_plane(movement.motion) || is_spline(movement.motion);
  if (arc &&
      !(state_.programmed_frame.keeps(state_.plane) && state_.offset_frame.keeps(state_.plane))) {
    return fail(movement.column, "arc-plane-turned"_id, "an arc in a plane that the frame turns",
                "write it as straight moves, or turn the frame about the normal of the plane");
  }
  return Done{};
}

}  // namespace frustum::parser

// The words that shift and turn the frame of the words that follow: G92, G52, G68.
#include <fmt/format.h>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/running/block_executor.hpp"

namespace frustum::parser {

// The tool stays where it is; its coordinates change.
void BlockExecutor::change_word_frame(const WordFrame& next) {
  const AxisTarget words = next.to_words(state_.word_frame.from_words(position_.target()));
  for (const AxisLetter axis : kAxisLetters) {
    if (words[axis]) {
      position_.set(axis, *words[axis]);
    } else {
      position_.forget(axis, PositionLoss::turned_frame, block_->line);
    }
  }
  state_.word_frame = next;
  state_.pole.reset();
}

BlockExecutor::Outcome BlockExecutor::shift_words(const BlockWords& words, NonModal how) {
  const GivenCode& code = words[CodeGroup::non_modal];
  WordFrame next = state_.word_frame;
  const auto clear = [&] {
    next.shift.setZero();
    next.rotary_shift = {};
  };
  switch (how) {
    case NonModal::shift_off:
      clear();
      state_.suspended_shift.reset();
      break;
    case NonModal::shift_suspend:
      state_.suspended_shift = next;
      clear();
      break;
    case NonModal::shift_resume:
      if (state_.suspended_shift) {
        next.shift = state_.suspended_shift->shift;
        next.rotary_shift = state_.suspended_shift->rotary_shift;
      }
      break;
    default:
      if ((words.given() & kAxisWords).empty()) {
        return fail(code.column, code.code->name() + " names no axis",
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
          shift = value;
          continue;
        }
        if (!position_[axis]) {
          return fail(words[letter].column,
                      fmt::format("{} says where {} is, but {}", code.code->name(), letter,
                                  position_.why_unknown(axis)),
                      fmt::format("move {} with G0 or G1 before", letter));
        }
        shift += *position_[axis] - value;
      }
  }
  change_word_frame(next);
  return Done{};
}

// G68: about the centre X Y (of the plane's axes) by R degrees.
BlockExecutor::Outcome BlockExecutor::turn_words(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  if (!words.has('R')) {
    return fail(code.column, code.code->name() + " without an angle", "give R in degrees");
  }
  const PlaneAxes axes = axes_of(state_.plane);
  Vec3 centre = Vec3::Zero();
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (words.has(to_char(letter))) {
      centre[axis] = scaled(letter, words[to_char(letter)].value);
    } else if (position_[letter]) {
      centre[axis] = *position_[letter];
    } else {
      return fail(code.column,
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              position_.why_unknown(letter)),
                  fmt::format("give {} on this block", to_char(letter)));
    }
  }
  WordFrame next = state_.word_frame;
  const Mat3 rotation = rotation_about(Vec3::Unit(axes.w), words['R'].value * kRadPerDeg);
  const Vec3 pivot = centre + next.shift;
  next.turn = Pose{rotation, pivot - rotation * pivot};
  change_word_frame(next);
  return Done{};
}

// A turned frame mixes the axes, so that all of them have to be known before one of them moves.
BlockExecutor::Outcome BlockExecutor::check_word_frame(const Movement& movement) const {
  if (!state_.word_frame.turns()) return Done{};
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    if (position_[axis]) continue;
    return fail(movement.column,
                fmt::format("a move in a turned frame, but {}", position_.why_unknown(axis)),
                "program X, Y and Z once, in absolute coordinates, after the frame is turned");
  }
  const bool arc = movement.motion == MotionMode::arc_clockwise ||
                   movement.motion == MotionMode::arc_counterclockwise;
  if (arc && !state_.word_frame.keeps(state_.plane)) {
    return fail(movement.column, "an arc in a plane that the frame turns",
                "write it as straight moves, or turn the frame about the normal of the plane");
  }
  return Done{};
}

}  // namespace frustum::parser

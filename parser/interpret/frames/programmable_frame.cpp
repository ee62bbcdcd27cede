#include "parser/interpret/frames/programmable_frame.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

bool goes_on(FrameWord word) {
  return word == FrameWord::shift_within || word == FrameWord::turn_within ||
         word == FrameWord::scale_within || word == FrameWord::mirror_within;
}

Result<ProgramFrame> scaling_of(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::program_frame];
  std::optional<double> factor;
  for (const char axis : {'X', 'Y', 'Z'}) {
    const double given = words.has(axis) ? words[axis].value : 1.0;
    if (factor && *factor != given) {
      return fail(state, words.has(axis) ? words[axis].column : code.column, "scaling-uneven"_id,
                  fmt::format("{} scales the axes in different ways", code.code->name()),
                  "circles would be none: give X, Y and Z the same factor");
    }
    factor = given;
  }
  if (!(*factor > 0.0)) {
    return fail(state, words['X'].column, "scaling-factor"_id,
                fmt::format("{} is no factor", words.text_of('X')),
                "a factor is above zero; mirror by MIRROR");
  }
  return ProgramFrame::scaling(*factor);
}

Result<ProgramFrame> frame_of(const InterpreterState& state, const BlockWords& words,
                              FrameWord word) {
  switch (word) {
    case FrameWord::shift:
    case FrameWord::shift_within: {
      std::array<double, 3> rotary{};
      for (std::size_t i = 0; i < rotary.size(); ++i) {
        rotary.at(i) = words["ABC"[i]].value * kRadPerDeg;
      }
      return ProgramFrame::shift(lengths_of(state, words, "XYZ"), rotary);
    }
    case FrameWord::turn:
    case FrameWord::turn_within:
      break;
    case FrameWord::scale:
    case FrameWord::scale_within:
      return scaling_of(state, words);
    case FrameWord::mirror:
    case FrameWord::mirror_within:
      return ProgramFrame::mirror({words.has('X'), words.has('Y'), words.has('Z')});
  }
  if (!words.has('R')) return ProgramFrame::turn(vector_of(words, "XYZ") * kRadPerDeg);
  if (const char axis = words.first_of(LetterSet("XYZ")); axis != 0) {
    return fail(state, words[axis].column, "word-ambiguous"_id,
                fmt::format("{} beside RPL", words.text_of(axis)),
                "turn in the plane by RPL, or about the axes by X Y Z");
  }
  Vec3 angles = Vec3::Zero();
  angles[axes_of(state.modes.plane).w] = words['R'].value * kRadPerDeg;
  return ProgramFrame::turn(angles);
}

}  // namespace

void set_program_frame(InterpreterState& state, const ProgramFrame& next) {
  const ProgramFrame& last = state.modes.program_frame;
  if (next.linear == last.linear && next.scale == last.scale && next.origin == last.origin &&
      next.rotary_shift == last.rotary_shift) {
    return;
  }
  state.modes.program_frame = next;
  change_programmed_frame(state, next.programmed_frame());
  // A step from a place that was written in another frame would be ambiguous.
  state.modes.placed_in_other_frame = kAxisWords;
}

Outcome change_program_frame(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::program_frame];
  if (code.code == nullptr) return Done{};
  const auto word = static_cast<FrameWord>(code.code->value);
  if ((words.given() & code.code->arguments).empty()) {
    if (goes_on(word)) {
      return fail(state, code.column, "axes-missing"_id, code.code->name() + " names no axis",
                  fmt::format("give the axes, for example {} X5", code.code->name()));
    }
    set_program_frame(state, {});
    state.modes.shift_was_added = false;
    return Done{};
  }
  if (word == FrameWord::shift && state.modes.shift_was_added) {
    assume(state, code.column, "TRANS after ATRANS",
           "TRANS replaces what ATRANS has added too (MD24000 off)");
  }
  state.modes.shift_was_added =
      word == FrameWord::shift_within || (goes_on(word) && state.modes.shift_was_added);
  const auto frame = frame_of(state, words, word);
  if (!frame) return frame.error();
  set_program_frame(state, goes_on(word) ? state.modes.program_frame.with(*frame) : *frame);
  return Done{};
}

}  // namespace frustum::parser

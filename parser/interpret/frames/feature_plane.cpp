#include "parser/interpret/frames/feature_plane.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "core/units.hpp"
#include "parser/interpret/frames/feature_frame.hpp"
#include "parser/interpret/frames/tilted_plane.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// What each form reads besides P, on its block with Q0 where it has several.
constexpr std::array<LetterSet, kFeatureForms> kFormWords{LetterSet("XYZIJK"), LetterSet("XYZIJKQ"),
                                                          LetterSet("XYZQR"), LetterSet("XYZIJKQ"),
                                                          LetterSet("XYZIJK")};

std::string missing_part(const FeatureWords& feature) {
  const int last = feature.form == FeatureForm::three_points ? 3 : 2;
  int part = 1;
  while (part < last && feature.parts.at(static_cast<std::size_t>(part))) ++part;
  return fmt::format("P{} Q{}", static_cast<int>(feature.form), part);
}

}  // namespace

Outcome set_feature(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  FeatureWords feature;
  if (words.has('P')) {
    const auto form = whole(state, words, 'P', 0, kFeatureForms - 1);
    if (!form) return form.error();
    feature.form = static_cast<FeatureForm>(*form);
  }
  const int form = static_cast<int>(feature.form);
  const bool several =
      feature.form == FeatureForm::three_points || feature.form == FeatureForm::two_vectors;
  if (several && state.modes.feature && state.modes.feature->form == feature.form)
    feature = *state.modes.feature;
  std::size_t slot = 0;
  if (several) {
    const bool points = feature.form == FeatureForm::three_points;
    if (!words.has('Q')) {
      return fail(state, code.column, "word-missing"_id,
                  fmt::format("{} P{} without Q", code.code->name(), form),
                  points ? "number the blocks: Q1 the origin, Q2 on +X, Q3 beside it"
                         : "number the blocks: Q1 the direction of +X, Q2 the normal");
    }
    const auto part = whole(state, words, 'Q', points ? 0 : 1, points ? 3 : 2);
    if (!part) return part.error();
    slot = static_cast<std::size_t>(*part);
  } else if (words.has('Q')) {
    const auto order = whole(state, words, 'Q', 0, 999);
    if (!order) return order.error();
    feature.order = *order;
  }
  LetterSet read = kFormWords.at(static_cast<std::size_t>(form));
  if (several && slot != 0) read = read.without(LetterSet("R"));
  if (feature.form == FeatureForm::two_vectors && slot == 2) read = LetterSet("IJKQ");
  const LetterSet unread = (words.given() & LetterSet("XYZIJKQR")).without(read);
  if (const char letter = words.first_of(unread); letter != 0) {
    return fail(
        state, words[letter].column, "word-unused"_id,
        fmt::format("{} has no meaning in {} P{}", words.text_of(letter), code.code->name(), form),
        "leave it out, or name the form by P: 0 Euler angles, 1 roll, pitch and yaw, 2 three "
        "points, "
        "3 two vectors, 4 projection angles");
  }
  FeaturePart part;
  part.place = lengths_of(state, words, "XYZ");
  part.numbers =
      vector_of(words, "IJK") * (feature.form == FeatureForm::two_vectors ? 1.0 : kRadPerDeg);
  part.turn = words['R'].value * kRadPerDeg;
  feature.parts.at(slot) = part;
  if (!feature.whole()) {
    state.modes.feature = feature;
    return Done{};
  }
  state.modes.feature.reset();
  const auto plane = feature_frame(feature);
  if (!plane) {
    return fail(state, words.has('Q') ? words['Q'].column : code.column, plane.error().front());
  }
  const bool within = static_cast<TiltWord>(code.code->value) == TiltWord::feature_within;
  if (within && !state.modes.tilted) {
    return fail(state, code.column, "plane-missing"_id,
                code.code->name() + " without a tilted plane",
                "it goes on from one: define that before, by G68.2");
  }
  return tilt(state, code, *plane, within);
}

Outcome check_feature(const InterpreterState& state, const Movement& movement) {
  if (!state.modes.feature || movement.motion == MotionMode::none) return Done{};
  return fail(state, movement.column, "plane-incomplete"_id,
              "a move while the tilted plane is described by halves",
              fmt::format("give G68.2 {} before", missing_part(*state.modes.feature)));
}

Outcome turn_in_space(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  const auto axis = UnitVec3::of(vector_of(words, "IJK"));
  if (!axis) {
    return fail(state, words[words.first_of(LetterSet("IJK"))].column, "plane-degenerate"_id,
                "the axis of the turn has no direction",
                "give I J K a length above zero, or leave them out to turn in the plane");
  }
  Vec3 centre;
  for (const AxisLetter letter : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<Eigen::Index>(letter);
    if (words.has(to_char(letter))) {
      centre[i] = scaled(state, letter, words[to_char(letter)].value);
    } else if (state.position[letter]) {
      centre[i] = *state.position[letter];
    } else {
      return fail(state, code.column, state.position.unknown_id(letter),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              state.position.why_unknown(letter)),
                  fmt::format("give {} on this block", to_char(letter)));
    }
  }
  return tilt(state, code, Pose{rotation_about(*axis, words['R'].value * kRadPerDeg), centre},
              true);
}

}  // namespace frustum::parser

// Tilted planes of Fanuc: G68.2 and G68.4 in all their forms, G68 about an axis in space.
#include <fmt/format.h>

#include "core/units.hpp"
#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/frames/feature_frame.hpp"

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

// The plane is in the frame of the words at work, which is that of the words again after G69.
BlockExecutor::Outcome BlockExecutor::tilt(const GivenCode& code, const Pose& plane, bool within) {
  if (!within && state_.frame_below) state_.programmed_frame = *state_.frame_below;
  if (state_.programmed_frame.is_mirrored() || state_.programmed_frame.scale != 1.0) {
    return fail(code.column, "plane-frame"_id,
                fmt::format("{} while the words are mirrored or scaled", code.code->name()),
                "end that before, by G50 and G50.1");
  }
  const Pose outer = within && state_.tilted ? state_.tilt : Pose{};
  const Pose words = state_.programmed_frame.turn * Pose::translated(state_.programmed_frame.shift);
  if (!state_.frame_below) state_.frame_below = state_.programmed_frame;
  state_.programmed_frame = ProgrammedFrame{.rotary_shift = state_.programmed_frame.rotary_shift};
  forget(kLinearWords, PositionLoss::tilted_plane);
  state_.tilted = true;
  state_.tilt = outer * words * plane;
  emit(code.column, TiltedPlaneChange{state_.tilt});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_feature(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  FeatureWords feature;
  if (words.has('P')) {
    const auto form = whole(words, 'P', 0, kFeatureForms - 1);
    if (!form) return form.error();
    feature.form = static_cast<FeatureForm>(*form);
  }
  const int form = static_cast<int>(feature.form);
  const bool several =
      feature.form == FeatureForm::three_points || feature.form == FeatureForm::two_vectors;
  if (several && state_.feature && state_.feature->form == feature.form) feature = *state_.feature;
  std::size_t slot = 0;
  if (several) {
    const bool points = feature.form == FeatureForm::three_points;
    if (!words.has('Q')) {
      return fail(code.column, "word-missing"_id,
                  fmt::format("{} P{} without Q", code.code->name(), form),
                  points ? "number the blocks: Q1 the origin, Q2 on +X, Q3 beside it"
                         : "number the blocks: Q1 the direction of +X, Q2 the normal");
    }
    const auto part = whole(words, 'Q', points ? 0 : 1, points ? 3 : 2);
    if (!part) return part.error();
    slot = static_cast<std::size_t>(*part);
  } else if (words.has('Q')) {
    const auto order = whole(words, 'Q', 0, 999);
    if (!order) return order.error();
    feature.order = *order;
  }
  LetterSet read = kFormWords.at(static_cast<std::size_t>(form));
  if (several && slot != 0) read = read.without(LetterSet("R"));
  if (feature.form == FeatureForm::two_vectors && slot == 2) read = LetterSet("IJKQ");
  const LetterSet unread = (words.given() & LetterSet("XYZIJKQR")).without(read);
  if (const char letter = words.first_of(unread); letter != 0) {
    return fail(
        words[letter].column, "word-unused"_id,
        fmt::format("{} has no meaning in {} P{}", words.text_of(letter), code.code->name(), form),
        "leave it out, or name the form by P: 0 Euler angles, 1 roll, pitch and yaw, 2 three "
        "points, "
        "3 two vectors, 4 projection angles");
  }
  FeaturePart part;
  part.place = vector_of(words, "XYZ") * unit_scale();
  part.numbers =
      vector_of(words, "IJK") * (feature.form == FeatureForm::two_vectors ? 1.0 : kRadPerDeg);
  part.turn = words['R'].value * kRadPerDeg;
  feature.parts.at(slot) = part;
  if (!feature.whole()) {
    state_.feature = feature;
    return Done{};
  }
  state_.feature.reset();
  const auto plane = feature_frame(feature);
  if (!plane) {
    return fail(words.has('Q') ? words['Q'].column : code.column, plane.error().front());
  }
  const bool within = static_cast<TiltWord>(code.code->value) == TiltWord::feature_within;
  if (within && !state_.tilted) {
    return fail(code.column, "plane-missing"_id, code.code->name() + " without a tilted plane",
                "it goes on from one: define that before, by G68.2");
  }
  return tilt(code, *plane, within);
}

BlockExecutor::Outcome BlockExecutor::check_feature(const Movement& movement) const {
  if (!state_.feature || movement.motion == MotionMode::none) return Done{};
  return fail(movement.column, "plane-incomplete"_id,
              "a move while the tilted plane is described by halves",
              fmt::format("give G68.2 {} before", missing_part(*state_.feature)));
}

// G68 X Y Z I J K R: about the axis I J K through X Y Z, which becomes the origin.
BlockExecutor::Outcome BlockExecutor::turn_in_space(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  const auto axis = UnitVec3::of(vector_of(words, "IJK"));
  if (!axis) {
    return fail(words[words.first_of(LetterSet("IJK"))].column, "plane-degenerate"_id,
                "the axis of the turn has no direction",
                "give I J K a length above zero, or leave them out to turn in the plane");
  }
  Vec3 centre;
  for (const AxisLetter letter : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    const auto i = static_cast<Eigen::Index>(letter);
    if (words.has(to_char(letter))) {
      centre[i] = scaled(letter, words[to_char(letter)].value);
    } else if (position_[letter]) {
      centre[i] = *position_[letter];
    } else {
      return fail(code.column, position_.unknown_id(letter),
                  fmt::format("the centre of {} is not known: {}", code.code->name(),
                              position_.why_unknown(letter)),
                  fmt::format("give {} on this block", to_char(letter)));
    }
  }
  return tilt(code, Pose{rotation_about(*axis, words['R'].value * kRadPerDeg), centre}, true);
}

}  // namespace frustum::parser

#include "parser/interpret/moves/rotary_paths.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/units.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kRotaryLetters = "ABC";

constexpr double kTurnInDegrees = 360.0;

RotaryPath rotary_path_of(InterpreterState& state, const BlockWords& words, char letter) {
  const GivenWord& word = words[letter];
  switch (word.measure) {
    case Measure::shortest:
      return RotaryPath::shortest;
    case Measure::positive:
      return RotaryPath::positive;
    case Measure::negative:
      return RotaryPath::negative;
    case Measure::modal:
    case Measure::absolute:
    case Measure::incremental:
      break;
  }
  const bool steps =
      word.measure == Measure::incremental ||
      (word.measure == Measure::modal && state.modes.distance == DistanceMode::incremental);
  const bool loose = state.modes.loose.at(kRotaryLetters.find(letter));
  if (!steps || !loose || state.modes.rotary_path != RotaryPath::as_programmed) {
    return state.modes.rotary_path;
  }
  // A step from a place known but for full turns goes on from there.
  if (std::abs(word.value) <= kTurnInDegrees / 2.0) return RotaryPath::shortest;
  if (std::abs(word.value) < kTurnInDegrees) {
    return word.value > 0.0 ? RotaryPath::positive : RotaryPath::negative;
  }
  assume(
      state, word.column, "rotary-step",
      fmt::format("a step of a full turn or more: {} has made no full turns beside its last word",
                  letter));
  return RotaryPath::as_programmed;
}

}  // namespace

Outcome check_turns_shown(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::rotary_display];
  if (code.code == nullptr) return Done{};
  for (std::size_t i = 0; i < kRotaryLetters.size(); ++i) {
    const auto& place = state.position[static_cast<AxisLetter>(3 + i)];
    if (!place) continue;
    const double shown = *place * kDegPerRad;
    if (std::abs(shown) < kTurnInDegrees) continue;
    return fail(state, code.column, "not-simulated"_id,
                fmt::format("{} takes full turns off {} = {:.6g} deg, which is not simulated",
                            code.code->name(), kRotaryLetters[i], shown),
                "turn by M126, or back to less than a full turn before");
  }
  return Done{};
}

void set_paths(InterpreterState& state, const BlockWords& words) {
  const GivenCode& orientation = words[CodeGroup::orientation_path];
  if (const GivenCode& reference = words[CodeGroup::orientation_reference];
      reference.code != nullptr) {
    state.modes.orientation_reference = static_cast<OrientationReference>(reference.code->value);
    emit(state, reference.column, Event{reference.code->name(), {}});
  }
  if (orientation.code != nullptr) {
    state.modes.orientation_path = static_cast<OrientationPath>(orientation.code->value);
    emit(state, orientation.column,
         OrientationPathChange{static_cast<OrientationPath>(orientation.code->value)});
  }
  const GivenCode& rotary = words[CodeGroup::rotary_path];
  if (rotary.code != nullptr) {
    state.modes.rotary_path = static_cast<RotaryPath>(rotary.code->value);
    state.modes.announced_rotary_paths.fill(state.modes.rotary_path);
    emit(state, rotary.column, RotaryPathChange{state.modes.rotary_path});
  }
}

Outcome announce_rotary_paths(InterpreterState& state, const BlockWords& words,
                              std::uint32_t column) {
  if ((words.given() & kRotaryWords).empty()) return Done{};
  std::array<std::optional<RotaryPath>, 3> paths{};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!words.has(kRotaryLetters[i])) continue;
    const RotaryPath path = rotary_path_of(state, words, kRotaryLetters[i]);
    state.modes.loose.at(i) = path != RotaryPath::as_programmed;
    if (path != state.modes.announced_rotary_paths.at(i)) paths.at(i) = path;
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!paths.at(i)) continue;
    RotaryPathChange change{*paths.at(i), {}};
    for (std::size_t k = i; k < paths.size(); ++k) {
      if (paths.at(k) != change.path) continue;
      change.axes.at(k) = true;
      state.modes.announced_rotary_paths.at(k) = change.path;
      paths.at(k).reset();
    }
    emit(state, column, change);
  }
  return Done{};
}

AxisTarget end_of(const InterpreterState& state, const BlockWords& words) {
  AxisTarget end = state.position.target();
  for (std::size_t i = 0; i < state.modes.loose.size(); ++i) {
    const char letter = kRotaryLetters[i];
    if (state.modes.loose.at(i) && !words.has(letter)) end[static_cast<AxisLetter>(3 + i)].reset();
  }
  return end;
}

Outcome check_orientation_reference(const InterpreterState& state, const BlockWords& words) {
  if (state.modes.orientation_reference == OrientationReference::workpiece) return Done{};
  const char vector = words.first_of(LetterSet(state.rules.vector_letters));
  const char first = vector != 0 ? vector : words.first_of(kRotaryWords);
  if (first == 0 || !state.modes.compensation.tip) return Done{};
  const std::uint32_t column = words[first].column;
  const bool turned = state.modes.tilted || state.modes.programmed_frame.turns() ||
                      state.modes.offset_frame.turns();
  if (vector != 0 && turned) {
    return fail(state, column, "orientation-reference"_id,
                "a tool vector of the machine (ORIMKS) in a frame that is turned",
                "give the vector in the frame of the words, with ORIWKS, or end the frame before");
  }
  if (state.modes.orientation_path == OrientationPath::great_circle) {
    return fail(state, column, "orientation-reference"_id,
                "ORIMKS and ORIVECT say different ways for the tool to turn",
                "write ORIAXES with ORIMKS, or ORIWKS with ORIVECT");
  }
  return Done{};
}

}  // namespace frustum::parser

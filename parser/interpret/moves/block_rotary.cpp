// How rotary words turn their axes, and in whose frame the directions of the tool are.
#include <fmt/format.h>

#include <cmath>

#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kRotaryLetters = "ABC";
constexpr double kTurnInDegrees = 360.0;

}  // namespace

Result<RotaryPath> BlockExecutor::rotary_path_of(const BlockWords& words, char letter) const {
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
      (word.measure == Measure::modal && state_.distance == DistanceMode::incremental);
  const bool loose = state_.loose.at(kRotaryLetters.find(letter));
  if (!steps || !loose || state_.rotary_path != RotaryPath::as_programmed) {
    return state_.rotary_path;
  }
  // A step from a place known but for full turns goes on from there.
  if (std::abs(word.value) <= kTurnInDegrees / 2.0) return RotaryPath::shortest;
  if (std::abs(word.value) < kTurnInDegrees) {
    return word.value > 0.0 ? RotaryPath::positive : RotaryPath::negative;
  }
  return fail(
      word.column, "rotary-step"_id,
      fmt::format("{} is a step of a full turn or more, from a place known but for full turns",
                  words.text_of(letter)),
      fmt::format("write smaller steps, or place {0} before by {0}=AC(0)", letter));
}

BlockExecutor::Outcome BlockExecutor::announce_rotary_paths(const BlockWords& words,
                                                            std::uint32_t column) {
  if ((words.given() & kRotaryWords).empty()) return Done{};
  std::array<std::optional<RotaryPath>, 3> paths{};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!words.has(kRotaryLetters[i])) continue;
    const auto path = rotary_path_of(words, kRotaryLetters[i]);
    if (!path) return path.error();
    state_.loose.at(i) = *path != RotaryPath::as_programmed;
    if (*path != state_.announced_rotary_paths.at(i)) paths.at(i) = *path;
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!paths.at(i)) continue;
    RotaryPathChange change{*paths.at(i), {}};
    for (std::size_t k = i; k < paths.size(); ++k) {
      if (paths.at(k) != change.path) continue;
      change.axes.at(k) = true;
      state_.announced_rotary_paths.at(k) = change.path;
      paths.at(k).reset();
    }
    emit(column, change);
  }
  return Done{};
}

// Axes that went another way than to a value are left where they are until they are named again.
AxisTarget BlockExecutor::end_of(const BlockWords& words) const {
  AxisTarget end = position_.target();
  for (std::size_t i = 0; i < state_.loose.size(); ++i) {
    const char letter = kRotaryLetters[i];
    if (state_.loose.at(i) && !words.has(letter)) end[static_cast<AxisLetter>(3 + i)].reset();
  }
  return end;
}

// In the frame of the machine a direction is the same as in the words' only while that is not turned; and whether
// the tool then goes along a great circle is a setting of the machine.
BlockExecutor::Outcome BlockExecutor::check_orientation_reference(const BlockWords& words) const {
  if (state_.orientation_reference == OrientationReference::workpiece) return Done{};
  const char vector = words.first_of(LetterSet(rules_.vector_letters));
  const char first = vector != 0 ? vector : words.first_of(kRotaryWords);
  if (first == 0 || !state_.compensation.tip) return Done{};
  const std::uint32_t column = words[first].column;
  const bool turned =
      state_.tilted || state_.programmed_frame.turns() || state_.offset_frame.turns();
  if (vector != 0 && turned) {
    return fail(column, "orientation-reference"_id,
                "a tool vector of the machine (ORIMKS) in a frame that is turned",
                "give the vector in the frame of the words, with ORIWKS, or end the frame before");
  }
  if (state_.orientation_path == OrientationPath::great_circle) {
    return fail(column, "orientation-reference"_id,
                "ORIMKS and ORIVECT say different ways for the tool to turn",
                "write ORIAXES with ORIMKS, or ORIWKS with ORIVECT");
  }
  return Done{};
}

}  // namespace frustum::parser

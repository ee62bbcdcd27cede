#include "parser/interpret/state/decimal_points.hpp"

#include <fmt/format.h>

#include <cmath>

#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {
namespace {

constexpr LetterSet kLengthsAndAngles{"XYZABCUVWIJKQR"};
// Further than a machine goes; in increments it is 1 mm and more.
constexpr double kImplausible = 1000.0;

// The letters whose numbers are lengths, angles or times in this block.
LetterSet measured(const InterpreterState& state, const BlockWords& words) {
  LetterSet letters = kLengthsAndAngles;
  const auto motion = words.value_or(CodeGroup::motion, state.modes.motion);
  const Code* non_modal = words[CodeGroup::non_modal].code;
  if (words.has(CodeGroup::tilted_plane)) letters = letters.without(LetterSet("Q"));
  if (is_cycle(motion)) letters = letters.without(LetterSet("K"));  // how many holes
  if (words.has(CodeGroup::scaling)) letters = letters.without(LetterSet("IJK"));
  if (state.modes.compensation.tool_vectors && !is_arc_in_plane(motion)) {
    letters = letters.without(LetterSet("IJK"));
  }
  const bool dwells =
      non_modal != nullptr && static_cast<NonModal>(non_modal->value) == NonModal::dwell;
  return dwells ? letters & LetterSet("XU") : letters;
}

void count_in_increments(const InterpreterState& state, BlockWords& words, LetterSet letters,
                         LengthUnit unit) {
  constexpr double kOfMillimetres = 1e-3;
  constexpr double kOfInches = 1e-4;
  constexpr LetterSet kAlike{"ABC"};
  const bool inches = unit == LengthUnit::inch;
  const bool dwells =
      words.has(CodeGroup::non_modal) &&
      static_cast<NonModal>(words[CodeGroup::non_modal].code->value) == NonModal::dwell;
  words.rescale(letters & kAlike, kOfMillimetres);
  words.rescale(letters.without(kAlike), inches && !dwells ? kOfInches : kOfMillimetres);
  if (!words.without_point().has('F')) return;
  const auto mode = words.value_or(CodeGroup::feed_mode, state.modes.feed_mode);
  if (mode == FeedMode::per_minute && inches) words.rescale(LetterSet("F"), 1e-2);
  if (mode == FeedMode::per_revolution) words.rescale(LetterSet("F"), inches ? kOfInches : 1e-2);
}

}  // namespace

void count_without_points(InterpreterState& state, BlockWords& words, LengthUnit unit) {
  if (state.rules.dialect != Dialect::fanuc || words.without_point().empty()) return;
  if (state.control.decimal_point == DecimalPoint::increment) {
    count_in_increments(state, words, words.without_point() & measured(state, words), unit);
    return;
  }
  const LetterSet axes = words.without_point() & kAxisWords;
  if (axes.empty() || state.output.assumptions.contains("decimal point")) return;
  const char letter = words.first_of(axes);
  const bool far = std::abs(words[letter].value) >= kImplausible;
  if (unit != LengthUnit::inch && !far) return;
  assume(state, words[letter].column, "decimal point",
         fmt::format("{} counts as it is written (calculator type), not in increments",
                     words.text_of(letter)));
}

}  // namespace frustum::parser

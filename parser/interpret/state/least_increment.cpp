#include "parser/interpret/state/least_increment.hpp"

#include <fmt/format.h>

#include <cmath>

namespace frustum::parser {
namespace {

constexpr LetterSet kAngles{"ABC"};
constexpr LetterSet kInIncrements{"XYZABCUVWIJKQRxy"};
// Of the same number: what a sum of decimals leaves.
constexpr double kSameNumber = 1e-9;

// I J K are lengths beside arcs alone, and R may be an angle of finer steps.
LetterSet rounded(const BlockWords& words, MotionMode motion) {
  LetterSet letters = words.computed() & kInIncrements;
  if (!is_arc_in_plane(motion)) letters = letters.without(LetterSet("IJK"));
  if (words.has(CodeGroup::tilted_plane)) letters = letters.without(LetterSet("QR"));
  return letters;
}

}  // namespace

double steps_of_unit(Dialect dialect, char letter, LengthUnit unit) {
  constexpr double kOfMillimetre = 1e3;
  constexpr double kOfInch = 1e4;
  if (dialect != Dialect::fanuc || !kInIncrements.has(letter)) return 1.0;
  return unit == LengthUnit::inch && !kAngles.has(letter) ? kOfInch : kOfMillimetre;
}

void round_computed(InterpreterState& state, BlockWords& words, MotionMode motion,
                    LengthUnit unit) {
  if (state.rules.dialect != Dialect::fanuc) return;
  for (LetterSet left = rounded(words, motion); !left.empty(); left = left.without_first()) {
    const char letter = left.first();
    const double computed = words[letter].value;
    words.round(letter, steps_of_unit(Dialect::fanuc, letter, unit));
    if (std::abs(words[letter].value - computed) <= kSameNumber) continue;
    assume(state, words[letter].column, "least increment",
           fmt::format("{} is {:.9g}, rounded to the least increment: 0.001 mm, 0.0001 inches, "
                       "0.001 degrees (IS-B)",
                       words.text_of(letter), computed));
  }
}

}  // namespace frustum::parser

#include "parser/interpret/cycles/bolt_holes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMostBolts = 9999;

Vec2 along_angle(double degrees) {
  return {std::cos(degrees * kRadPerDeg), std::sin(degrees * kRadPerDeg)};
}

}  // namespace

Result<std::vector<Vec2>> bolt_places(InterpreterState& state, const BlockWords& words) {
  std::vector<Vec2> places;
  const GivenCode& code = words[CodeGroup::bolt_holes];
  if (code.code == nullptr) return places;
  const auto kind = static_cast<BoltWord>(code.code->value);
  for (const char letter : {'I', 'K'}) {
    if (words.has(letter) || (letter == 'K' && kind != BoltWord::arc)) continue;
    return fail(state, code.column, "cycle-word-missing"_id,
                fmt::format("{} has no {}", code.code->name(), letter),
                letter == 'K'            ? "give K, the angle between the holes"
                : kind == BoltWord::line ? "give I, the distance between the holes"
                                         : "give I, the radius of the circle");
  }
  const auto count = whole(state, words, 'L', 0, kMostBolts);
  if (!count) return count.error();
  const double reach = length_of(state, words['I'].value);
  const double first = words.has('J') ? words['J'].value : 0.0;
  const double step = kind == BoltWord::arc ? words['K'].value : 360.0 / *count;
  for (int hole = 0; hole < *count; ++hole) {
    places.push_back(kind == BoltWord::line ? hole * reach * along_angle(first)
                                            : reach * along_angle(first + hole * step));
  }
  if (kind == BoltWord::line) {
    assume(state, code.column, "G72 L", "the first hole of the line is where the tool is");
  }
  return places;
}

}  // namespace frustum::parser

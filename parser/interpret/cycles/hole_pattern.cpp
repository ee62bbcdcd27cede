#include "parser/interpret/cycles/hole_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMostHoles = 9999;

Vec2 direction_of(double degrees) {
  return {std::cos(degrees * kRadPerDeg), std::sin(degrees * kRadPerDeg)};
}

// From the end of the row that is nearer to the tool.
void turn_row(InterpreterState& state, std::uint32_t column, std::vector<Vec2>& places) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto& u = state.position[static_cast<AxisLetter>(axes.u)];
  const auto& v = state.position[static_cast<AxisLetter>(axes.v)];
  if (!u || !v) {
    assume(state, column, "hole-order", "a row of holes begins with its first one");
    return;
  }
  const Vec2 tool(*u, *v);
  if ((places.back() - tool).norm() < (places.front() - tool).norm()) {
    std::reverse(places.begin(), places.end());
  }
}

}  // namespace

Result<std::vector<Vec2>> pattern_places(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_pattern];
  const auto kind = static_cast<PatternWord>(code.code->value);
  const double scale = unit_scale(state);
  if (!words.has('k')) {
    return fail(state, code.column, "cycle-word-missing"_id,
                code.code->name() + " has no number of holes",
                "give all parameters of the pattern");
  }
  const auto count = whole(state, words, 'k', 0, kMostHoles);
  if (!count) return count.error();
  const auto rows =
      kind == PatternWord::grid ? whole(state, words, 'l', 0, kMostHoles) : Result<int>{1};
  if (!rows) return rows.error();
  for (const char letter : {'f', 'r'}) {
    if (!words.has(letter) || words[letter].value >= 0.0 || kind == PatternWord::grid) continue;
    return fail(state, words[letter].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(letter)),
                "distances and radii have no sign");
  }
  const Vec2 reference = scale * Vec2(words['u'].value, words['v'].value);
  const double angle = words['q'].value;
  std::vector<Vec2> places;
  if (kind == PatternWord::circle) {
    const double step = words['d'].value != 0.0 ? words['d'].value : 360.0 / std::max(*count, 1);
    for (int i = 0; i < *count; ++i) {
      places.emplace_back(reference + scale * words['r'].value * direction_of(angle + i * step));
    }
    return places;
  }
  const Vec2 along = direction_of(angle);
  const Vec2 across(-along.y(), along.x());
  const bool grid = kind == PatternWord::grid;
  const double first = grid ? 0.0 : words['f'].value;
  const double step = words[grid ? 'f' : 'd'].value;
  for (int row = 0; row < *rows; ++row) {
    for (int i = 0; i < *count; ++i) {
      const int place = row % 2 == 0 ? i : *count - 1 - i;
      places.emplace_back(
          reference + scale * ((first + place * step) * along + row * words['d'].value * across));
    }
  }
  if (places.empty()) return places;
  if (grid) {
    assume(state, code.column, "hole-order",
           "a grid of holes is drilled from its reference point on, row by row, to and fro");
  } else {
    turn_row(state, code.column, places);
  }
  return places;
}

}  // namespace frustum::parser

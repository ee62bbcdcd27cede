#include "parser/interpret/cycles/hole_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  if (places.size() > 1) {
    assume(state, column, "HOLES1", "the row begins with the end that is nearer to the tool");
  }
  const Vec2 tool(*u, *v);
  if ((places.back() - tool).norm() < (places.front() - tool).norm()) {
    std::reverse(places.begin(), places.end());
  }
}

struct Grid {
  Vec2 reference = Vec2::Zero();
  Vec2 along = Vec2::UnitX();
  Vec2 across = Vec2::UnitY();
  Vec2 spacing = Vec2::Zero();
  std::array<int, 2> count{};
};

// To and fro along the axis with the smaller spacing, from the corner that is nearest to the tool.
std::vector<Vec2> grid_places(InterpreterState& state, std::uint32_t column, const Grid& grid) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto& u = state.position[static_cast<AxisLetter>(axes.u)];
  const auto& v = state.position[static_cast<AxisLetter>(axes.v)];
  Vec2 tool = grid.reference;
  if (u && v) {
    tool = Vec2(*u, *v);
    assume(state, column, "CYCLE801",
           "the grid begins at the corner nearest to the tool, along its closer holes");
  } else {
    assume(state, column, "hole-order", "a grid of holes begins with its first one");
  }
  const Vec2 from = tool - grid.reference;
  const Vec2 seen(from.dot(grid.along), from.dot(grid.across));
  const std::size_t inner = grid.spacing.x() <= grid.spacing.y() ? 0 : 1;
  const std::size_t outer = 1 - inner;
  // Whether the tool is on the far side of the middle.
  const auto far = [&](std::size_t axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    return (grid.count.at(axis) - 1) * grid.spacing[i] / 2.0 < seen[i];
  };
  std::vector<Vec2> places;
  for (int row = 0; row < grid.count.at(outer); ++row) {
    for (int i = 0; i < grid.count.at(inner); ++i) {
      const bool back = far(inner) != (row % 2 == 1);
      std::array<int, 2> place{};
      place.at(inner) = back ? grid.count.at(inner) - 1 - i : i;
      place.at(outer) = far(outer) ? grid.count.at(outer) - 1 - row : row;
      places.emplace_back(grid.reference + place[0] * grid.spacing.x() * grid.along +
                          place[1] * grid.spacing.y() * grid.across);
    }
  }
  return places;
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
  if (kind == PatternWord::grid) {
    const Vec2 spacing = scale * Vec2(words['f'].value, words['d'].value).cwiseAbs();
    return grid_places(state, code.column, {reference, along, across, spacing, {*count, *rows}});
  }
  for (int i = 0; i < *count; ++i) {
    places.emplace_back(reference + scale * (words['f'].value + i * words['d'].value) * along);
  }
  if (!places.empty()) turn_row(state, code.column, places);
  return places;
}

}  // namespace frustum::parser

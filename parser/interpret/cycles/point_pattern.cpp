#include "parser/interpret/cycles/point_pattern.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/units.hpp"
#include "parser/interpret/state/word_values.hpp"
#include "parser/language/point_pattern.hpp"

namespace frustum::parser {
namespace {

constexpr double kMostPoints = 9'999.0;  // of a pattern
constexpr double kLargestPlace = 1e15;   // as for words

// The values of an element by their letters; zero where one is not given.
struct PatternValues {
  const FramePart* part;
  std::vector<double> values{};

  [[nodiscard]] bool has(char letter) const { return part->axes.find(letter) != std::string::npos; }
  [[nodiscard]] double operator[](char letter) const {
    const std::size_t place = part->axes.find(letter);
    return place == std::string::npos ? 0.0 : values[place];
  }
};

Vec2 direction_by(double degrees) {
  return {std::cos(degrees * kRadPerDeg), std::sin(degrees * kRadPerDeg)};
}

Result<PatternValues> values_of(const InterpreterState& state, const FramePart& part,
                                std::uint32_t column) {
  const Block& block = *state.at_work.block;
  PatternValues values{&part};
  for (std::size_t i = 0; i < part.values.size(); ++i) {
    const auto value = evaluate({block.steps, block.names, state.parameters}, part.values[i]);
    if (!value) return in_this_block(state, value.error().front());
    if (is_symbol(*value) || !(std::abs(*value) <= kLargestPlace)) {
      return fail(state, column, "unknown-value"_id,
                  fmt::format("{} of {} is no number that the program knows",
                              pattern_word(part.axes[i]), part.name),
                  "give a number");
    }
    values.values.push_back(*value);
  }
  return values;
}

// A whole number of points.
Result<int> points_along(const InterpreterState& state, const PatternValues& values, char letter,
                         std::uint32_t column) {
  const double count = values[letter];
  if (count >= 1.0 && count <= kMostPoints && count == std::round(count)) {
    return static_cast<int>(count);
  }
  return fail(state, column, "value-not-whole"_id,
              fmt::format("{} of {} is {:g}", pattern_word(letter), values.part->name, count),
              fmt::format("a pattern has 1 to {:g} points", kMostPoints));
}

// PAT and FRAME, as steps along X and Y.
std::vector<Vec2> steps_of_grid(int columns, int lines, bool border) {
  std::vector<Vec2> steps;
  if (!border || columns == 1 || lines == 1) {
    for (int line = 0; line < lines; ++line) {
      for (int i = 0; i < columns; ++i) {
        steps.emplace_back(line % 2 == 0 ? i : columns - 1 - i, line);
      }
    }
    return steps;
  }
  for (int i = 0; i < columns; ++i) steps.emplace_back(i, 0);
  for (int line = 1; line < lines; ++line) steps.emplace_back(columns - 1, line);
  for (int i = columns - 2; i >= 0; --i) steps.emplace_back(i, lines - 1);
  for (int line = lines - 2; line > 0; --line) steps.emplace_back(0, line);
  return steps;
}

// The places of an element, as written.
Result<std::vector<Vec2>> places_of(const InterpreterState& state, const PatternValues& values,
                                    std::uint32_t column) {
  const std::string_view name = values.part->name;
  const Vec2 reference(values['X'], values['Y']);
  if (name.starts_with("POS")) return std::vector<Vec2>{reference};
  std::vector<Vec2> places;
  if (values.has('x')) {
    const auto columns = points_along(state, values, 'x', column);
    if (!columns) return columns.error();
    const auto lines = points_along(state, values, 'y', column);
    if (!lines) return lines.error();
    if (static_cast<double>(*columns) * *lines > kMostPoints) {
      return fail(state, column, "out-of-range"_id,
                  fmt::format("{} has {} times {} points", name, *columns, *lines),
                  fmt::format("a pattern has 1 to {:g} points", kMostPoints));
    }
    constexpr double kRightAngle = 90.0;
    const Vec2 along = values['u'] * direction_by(values['R'] + values['a']);
    const Vec2 across = values['v'] * direction_by(values['R'] + values['b'] + kRightAngle);
    for (const Vec2& step : steps_of_grid(*columns, *lines, name.starts_with("FRAME"))) {
      places.emplace_back(reference + step.x() * along + step.y() * across);
    }
    return places;
  }
  const auto count = points_along(state, values, 'N', column);
  if (!count) return count.error();
  constexpr double kWholeTurn = 360.0;
  const bool row = name.starts_with("ROW");
  double step = kWholeTurn / *count;
  if (values.has('T')) step = values['T'];
  if (values.has('E')) step = (values['E'] - values['S']) / std::max(*count - 1, 1);
  for (int i = 0; i < *count; ++i) {
    places.emplace_back(reference +
                        (row ? i * values['D'] * direction_by(values['R'])
                             : values['D'] / 2.0 * direction_by(values['S'] + i * step)));
  }
  return places;
}

}  // namespace

Outcome set_point_pattern(InterpreterState& state, const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::hole_pattern].column;
  const double scale = unit_scale(state);
  std::vector<Vec3> points;
  for (const FramePart& part : state.at_work.block->pattern) {
    const auto values = values_of(state, part, column);
    if (!values) return values.error();
    if (part.name.starts_with("PITCHCIRC") && values->has('T') == values->has('E')) {
      return fail(state, column, "value-missing"_id,
                  part.name + " has neither STEP nor END, or both", "give one of them");
    }
    const auto places = places_of(state, *values, column);
    if (!places) return places.error();
    for (const Vec2& place : *places) {
      points.emplace_back(place.x() * scale, place.y() * scale, (*values)['Z'] * scale);
    }
  }
  state.modes.point_pattern = std::move(points);
  return Done{};
}

}  // namespace frustum::parser

#include "parser/interpret/state/word_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"

namespace frustum::parser {

double unit_scale(const InterpreterState& state) {
  return state.modes.unit == LengthUnit::millimetre ? 1.0 : kMmPerInch;
}

double length_of(const InterpreterState& state, double value) {
  state.system.read_by_unit(value);
  return value * unit_scale(state);
}

Vec3 lengths_of(const InterpreterState& state, const BlockWords& words, std::string_view letters) {
  Vec3 lengths = vector_of(words, letters);
  for (double& length : lengths) length = length_of(state, length);
  return lengths;
}

double scaled(const InterpreterState& state, AxisLetter axis, double value) {
  if (is_rotary(axis)) return value * kRadPerDeg;
  const double share = axis == AxisLetter::X && state.modes.diameter ? 0.5 : 1.0;
  return share * length_of(state, value);
}

double feed_scale(const InterpreterState& state, FeedMode mode) {
  if (mode != FeedMode::inverse_time) state.system.read_by_unit(1.0);
  if (state.modes.unit != LengthUnit::inch || mode == FeedMode::inverse_time) return 1.0;
  return mode == FeedMode::per_minute ? state.rules.inch_feed * kMmPerInch : kMmPerInch;
}

Result<int> whole(const InterpreterState& state, const BlockWords& words, char letter, int least,
                  int most) {
  const GivenWord& word = words[letter];
  const double nearest = std::round(word.value);
  // RS-274 forgives 1e-4 in numbers that have to be whole.
  if (std::abs(word.value - nearest) > 1e-4) {
    return fail(state, word.column, "not-whole"_id,
                fmt::format("{} is not a whole number", words.text_of(letter)),
                fmt::format("give {} without decimals", words.name_of(letter)));
  }
  if (nearest < least || nearest > most) {
    return fail(state, word.column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of(letter)),
                fmt::format("{} goes from {} to {}", words.name_of(letter), least, most));
  }
  return static_cast<int>(nearest);
}

Vec3 vector_of(const BlockWords& words, std::string_view letters) {
  return {words[letters[0]].value, words[letters[1]].value, words[letters[2]].value};
}

Result<double> value_of(InterpreterState& state, const Block& block, ExpressionRange range) {
  state.at_work.block = &block;
  auto value = evaluate({block.steps, block.names, state.parameters}, range);
  if (!value) return in_this_block(state, value.error().front());
  return value;
}

}  // namespace frustum::parser

#include "parser/interpret/moves/cubic_in_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kTolerance = 1e-4;  // mm
constexpr double kMostLines = 1e6;

using Cubic = std::array<Vec3, 4>;

Vec3 point_at(const Cubic& cubic, double t) {
  const double s = 1.0 - t;
  return s * s * s * cubic[0] + 3.0 * s * s * t * cubic[1] + 3.0 * s * t * t * cubic[2] +
         t * t * t * cubic[3];
}

// A chord over h of the parameter is within h^2/8 of the greatest second derivative, which is at
// one of the ends.
double lines_of(const Cubic& cubic) {
  const double bend = 6.0 * std::max((cubic[0] - 2.0 * cubic[1] + cubic[2]).norm(),
                                     (cubic[1] - 2.0 * cubic[2] + cubic[3]).norm());
  return std::max(std::ceil(std::sqrt(bend / (8.0 * kTolerance))), 1.0);
}

}  // namespace

Outcome move_along_cubic_in_space(InterpreterState& state, const BlockWords& words,
                                  const Movement& movement) {
  AxisTarget target = end_of(state, words);
  Cubic cubic{};
  for (const AxisLetter letter : kLinearAxes) {
    const auto slot = static_cast<Eigen::Index>(letter);
    if (!state.position[letter]) {
      return fail(state, movement.column, state.position.unknown_id(letter),
                  fmt::format("the start of the spline is not known: {}",
                              state.position.why_unknown(letter)),
                  "move to the start before");
    }
    cubic[0][slot] = *state.position[letter];
    cubic[1][slot] = length_of(state, words["IJK"[slot]].value);
    cubic[2][slot] = length_of(state, words["uvw"[slot]].value);
  }
  LetterSet turning = kRotaryWords;
  if (state.modes.compensation.tip) turning = turning | LetterSet(state.rules.vector_letters);
  if (const char letter = words.first_of(turning); letter != 0) {
    return fail(state, words[letter].column, "spline-axes"_id,
                fmt::format("{} in a spline", words.text_of(letter)),
                "turn the tool by a GOTO before");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  for (const AxisLetter letter : kLinearAxes) {
    cubic[3][static_cast<Eigen::Index>(letter)] = *state.position[letter];
  }
  const double count = lines_of(cubic);
  if (!(count <= kMostLines)) {
    return fail(state, movement.column, "spline-points"_id, "the control points are too far apart",
                "correct them");
  }
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  emit(state, movement.column,
       Event{"NURBS", fmt::format("a cubic as {} lines within {} mm", count, kTolerance)});
  const AxisTarget end = end_of(state, words);
  for (double i = 1.0; i < count; i += 1.0) {
    const Vec3 point = point_at(cubic, i / count);
    for (const AxisLetter axis : kLinearAxes) target[axis] = point[static_cast<Eigen::Index>(axis)];
    emit(state, movement.column,
         LinearFeed{target, state.modes.tool_axis, Coordinates::program, *feed});
  }
  emit(state, movement.column, LinearFeed{end, state.modes.tool_axis, Coordinates::program, *feed});
  return Done{};
}

}  // namespace frustum::parser

#include "parser/interpret/moves/arc_through_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "parser/arc.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kBetween = "uvw";

constexpr double kInPlane = 1e-6;  // mm: below every control's increment
// A circle through three points that deviate by less from a line is not determined by written
// coordinates.
constexpr double kOnLine = 1e-9;

// How far a chord stays within its arc, a tenth of what a control resolves.
constexpr double kSagitta = 1e-4;         // mm
constexpr double kMostChords = 10'000.0;  // a full circle of 2 m

struct SpaceArc {
  Vec3 centre;
  Vec3 normal;   // counterclockwise about it
  double angle;  // from start to end, above zero
};

// Through three points that are not on a line.
SpaceArc arc_through(const Vec3& start, const Vec3& between, const Vec3& end) {
  const Vec3 a = between - start;
  const Vec3 b = end - start;
  const Vec3 n = a.cross(b);
  const Vec3 centre = start + (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) /
                                  (2.0 * n.squaredNorm());
  const Vec3 normal = n.normalized();
  const Vec3 from = start - centre;
  const Vec3 to = end - centre;
  double angle = std::atan2(normal.dot(from.cross(to)), from.dot(to));
  if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
  return {centre, normal, angle};
}

// I1= J1= K1=, as the words of the end count. A coordinate that is left out is that of start and
// end.
Result<Vec3> point_between(const InterpreterState& state, const BlockWords& words,
                           const Movement& movement, const Vec3& start, const Vec3& end) {
  Vec3 point = start;
  if (words.first_of(LetterSet(kBetween)) == 0) {
    return fail(state, movement.column, "arc-point-missing"_id, "CIP without a point between",
                "give a point of the arc by I1= J1= K1=");
  }
  for (const AxisLetter axis : kLinearAxes) {
    const auto slot = static_cast<Eigen::Index>(axis);
    const char letter = kBetween[static_cast<std::size_t>(axis)];
    if (!words.has(letter)) {
      if (std::abs(end[slot] - start[slot]) <= kInPlane) continue;
      return fail(state, movement.column, "arc-point-missing"_id,
                  fmt::format("CIP moves {} and has no {}1=", to_char(axis), "IJK"[slot]),
                  "give the point between with all axes that move");
    }
    const Measure measure = words[letter].measure;
    const bool steps =
        measure == Measure::incremental ||
        (measure == Measure::modal && state.modes.distance == DistanceMode::incremental);
    point[slot] = length_of(state, words[letter].value) + (steps ? start[slot] : 0.0);
  }
  return point;
}

// An arc about an axis, which climbs along it where it is a helix.
struct Turn {
  Vec3 centre;
  Vec3 arm;     // from there to the start
  Vec3 normal;  // counterclockwise about it
  double angle;
  double rise = 0.0;
};

Outcome cut_into_chords(InterpreterState& state, const BlockWords& words, const Movement& movement,
                        const AxisTarget& before, const Turn& turn, Feed feed) {
  LetterSet turning = kRotaryWords;
  if (state.modes.compensation.tip) turning = turning | LetterSet(state.rules.vector_letters);
  if (const char letter = words.first_of(turning); letter != 0) {
    return fail(state, words[letter].column, "arc-rotary"_id,
                fmt::format("{} beside an arc in space", words.text_of(letter)),
                "turn the tool in a block of its own, or write the arc as short G1 blocks");
  }
  const double angle = turn.angle;
  const double radius = turn.arm.norm();
  const double step = 4.0 * std::asin(std::sqrt(std::min(kSagitta / (2.0 * radius), 1.0)));
  const double count = std::max(std::ceil(angle / step), 1.0);
  if (!(count <= kMostChords)) {
    return fail(state, movement.column, "arc-too-long"_id,
                fmt::format("an arc in space of radius {:.6g} mm", radius),
                "check the point between; write an arc that is nearly straight as G1");
  }
  emit(state, movement.column,
       Event{movement.motion == MotionMode::arc_through ? "CIP" : "CIRCLE",
             fmt::format("an arc in space as {} lines within {} mm", count, kSagitta)});
  if (feed.mode == FeedMode::inverse_time) feed.value *= count;
  const AxisTarget end = end_of(state, words);
  AxisTarget target = before;
  for (double i = 1.0; i < count; i += 1.0) {
    const double part = angle * i / count;
    const Vec3 point = turn.centre + std::cos(part) * turn.arm +
                       std::sin(part) * turn.normal.cross(turn.arm) +
                       turn.normal * (turn.rise * i / count);
    for (const AxisLetter axis : kLinearAxes) target[axis] = point[static_cast<Eigen::Index>(axis)];
    emit(state, movement.column,
         LinearFeed{target, state.modes.tool_axis, Coordinates::program, feed});
  }
  emit(state, movement.column, LinearFeed{end, state.modes.tool_axis, Coordinates::program, feed});
  return Done{};
}

}  // namespace

Outcome move_through_point(InterpreterState& state, const BlockWords& words,
                           const Movement& movement) {
  if (state.contour_exit.arc_waits) {
    return fail(state, movement.column, "radius-compensation"_id,
                "the first move after radius compensation is an arc",
                "leave the contour by a straight move");
  }
  const AxisTarget before = end_of(state, words);
  Vec3 start = Vec3::Zero();
  for (const AxisLetter axis : kLinearAxes) {
    const auto slot = static_cast<Eigen::Index>(axis);
    const bool named =
        words.has(to_char(axis)) || words.has(kBetween[static_cast<std::size_t>(axis)]);
    const bool in_plane = slot != axes_of(state.modes.plane).w;
    if (!state.position[axis] && (named || in_plane)) {
      return fail(
          state, movement.column, state.position.unknown_id(axis),
          fmt::format("the start of the arc is not known: {}", state.position.why_unknown(axis)),
          "move to the start with G0 or G1 in G90 first");
    }
    start[slot] = state.position[axis].value_or(0.0);
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = set_tool_axis(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  Vec3 end = start;
  for (const AxisLetter axis : kLinearAxes) {
    end[static_cast<Eigen::Index>(axis)] = state.position[axis].value_or(0.0);
  }
  const auto between = point_between(state, words, movement, start, end);
  if (!between) return between.error();
  const Vec3 a = *between - start;
  const Vec3 b = end - start;
  const double least = kOnLine * (start.norm() + a.norm() + b.norm());
  if (!(a.norm() > least && b.norm() > least && (end - *between).norm() > least) ||
      !(a.cross(b).norm() > kOnLine * a.norm() * b.norm())) {
    return fail(state, words[words.first_of(LetterSet(kBetween))].column, "arc-straight"_id,
                "start, end and the point between are on a line",
                "give three points of a circle, or write a straight move");
  }
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  const SpaceArc arc = arc_through(start, *between, end);
  state.modes.heading = Heading{end, arc.normal.cross(end - arc.centre)};
  for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz}) {
    const int w = axes_of(plane).w;
    if (std::abs(a[w]) > kInPlane || std::abs(b[w]) > kInPlane) continue;
    if (!state.modes.programmed_frame.keeps(plane) || !state.modes.offset_frame.keeps(plane))
      continue;
    emit(state, movement.column,
         ArcFeed{end_of(state, words), arc.centre, plane, arc.normal[w] > 0.0 ? 1 : -1,
                 state.modes.tool_axis, *feed});
    return Done{};
  }
  return cut_into_chords(state, words, movement, before,
                         {arc.centre, start - arc.centre, arc.normal, arc.angle}, *feed);
}

Outcome move_about_axis(InterpreterState& state, const BlockWords& words,
                        const Movement& movement) {
  constexpr double kSameRadius = 0.01;  // mm: CAM systems write three decimals
  constexpr double kNoTurn = 1e-6;      // rad
  const AxisTarget before = end_of(state, words);
  Vec3 start = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
  Vec3 axis = Vec3::Zero();
  for (const AxisLetter letter : kLinearAxes) {
    const auto slot = static_cast<Eigen::Index>(letter);
    if (!state.position[letter]) {
      return fail(
          state, movement.column, state.position.unknown_id(letter),
          fmt::format("the start of the arc is not known: {}", state.position.why_unknown(letter)),
          "move to the start before");
    }
    start[slot] = *state.position[letter];
    centre[slot] = length_of(state, words["IJK"[slot]].value);
    axis[slot] = words[kBetween[static_cast<std::size_t>(slot)]].value;
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = set_tool_axis(state, words); !done) return done;
  Vec3 end = start;
  for (const AxisLetter letter : kLinearAxes) {
    end[static_cast<Eigen::Index>(letter)] = *state.position[letter];
  }
  const double height = (start - centre).dot(axis);
  const Vec3 from = start - centre - axis * height;
  const double rise = (end - start).dot(axis);
  const Vec3 to = end - centre - axis * (height + rise);
  if (!(std::abs(from.norm() - to.norm()) <= kSameRadius) || !(from.norm() > 0.0)) {
    return fail(state, movement.column, "arc-radius"_id,
                fmt::format("the arc begins {:.6g} mm from its axis and ends {:.6g} mm from it",
                            from.norm(), to.norm()),
                "correct the centre or the end");
  }
  double angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
  if (angle <= kNoTurn) angle += 2.0 * std::numbers::pi;
  if (words.has('P')) angle += 2.0 * std::numbers::pi * (words['P'].value - 1.0);
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  return cut_into_chords(state, words, movement, before,
                         {centre + axis * height, from, axis, angle, rise}, *feed);
}

}  // namespace frustum::parser

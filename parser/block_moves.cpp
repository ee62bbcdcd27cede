// The moves of a block: G28, G53, straight lines and arcs, and what they do to the known position.
#include <fmt/format.h>

#include <utility>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxTurns = 10'000;
constexpr std::array kSpatialAxes{AxisLetter::X, AxisLetter::Y, AxisLetter::Z};

const char* motion_name(MotionMode motion) {
  constexpr std::array kNames{"", "G0", "G1", "G2", "G3"};
  return kNames.at(static_cast<std::size_t>(motion));
}

// Whether X, Y or Z moves between two targets; an axis first placed now counts as moving.
bool moves_linearly(const AxisTarget& before, const AxisTarget& after) {
  for (const AxisLetter axis : kSpatialAxes) {
    if (after[axis] && before[axis] != after[axis]) return true;
  }
  return false;
}

Vec3 spatial(const AxisTarget& target, const Vec3& otherwise) {
  Vec3 point = otherwise;
  for (const AxisLetter axis : kSpatialAxes) {
    const auto slot = static_cast<Eigen::Index>(axis);
    point[slot] = target[axis].value_or(otherwise[slot]);
  }
  return point;
}

}  // namespace

BlockExecutor::Outcome BlockExecutor::move(const BlockWords& words, const Movement& movement) {
  // Axis words or not, the motion word stays in force for the blocks after.
  state_.motion = motion_of(words);
  if (movement.non_modal == NonModal::home) return go_home(words);
  if (movement.non_modal == NonModal::machine_coordinates) {
    return move_in_machine_coordinates(words, movement);
  }
  switch (movement.motion) {
    case MotionMode::none:
      return Done{};
    case MotionMode::traverse:
    case MotionMode::linear:
      return move_straight(words, movement);
    case MotionMode::arc_clockwise:
    case MotionMode::arc_counterclockwise:
      return move_along_arc(words, movement);
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::go_home(const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  const AxisTarget before = position_.target();
  HomeReturn home;
  LetterSet named;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    home.axes.at(static_cast<std::size_t>(axis)) = true;
    named.add(letter);
    // "G91 G28 Z0" from a place that is not known goes straight home: zero needs no start.
    const bool stays = state_.distance == DistanceMode::incremental && words[letter].value == 0.0;
    if (stays) continue;
    if (auto done = set_target(words, axis); !done) return done;
  }
  if (!(position_.target() == before)) {
    emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  }
  emit(column, Command{home});
  leave_program_coordinates(named, PositionLoss::home);
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::move_in_machine_coordinates(const BlockWords& words,
                                                                  const Movement& movement) {
  AxisTarget end;
  LetterSet named;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    end[axis] = scaled(axis, words[letter].value);
  }
  if (movement.motion == MotionMode::traverse) {
    emit(movement.column, Traverse{end, std::nullopt, Coordinates::machine});
  } else {
    const auto feed = feed_for(words, movement, moves_linearly({}, end));
    if (!feed) return feed.error();
    emit(movement.column, LinearFeed{end, std::nullopt, Coordinates::machine, *feed});
  }
  leave_program_coordinates(named, PositionLoss::machine_coordinates);
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::move_straight(const BlockWords& words,
                                                    const Movement& movement) {
  const AxisTarget before = position_.target();
  if (auto done = set_targets(words); !done) return done;
  if (auto done = set_tool_axis(words); !done) return done;
  const AxisTarget& end = position_.target();
  if (movement.motion == MotionMode::traverse) {
    emit(movement.column, Traverse{end, state_.tool_axis, Coordinates::program});
    return Done{};
  }
  const auto feed = feed_for(words, movement, moves_linearly(before, end));
  if (!feed) return feed.error();
  emit(movement.column, LinearFeed{end, state_.tool_axis, Coordinates::program, *feed});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::move_along_arc(const BlockWords& words,
                                                     const Movement& movement) {
  const PlaneAxes axes = axes_of(state_.plane);
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (!position_[letter]) {
      return fail(
          movement.column,
          fmt::format("the start of the arc is not known: {}", position_.why_unknown(letter)),
          "move to the start with G0 or G1 in G90 first");
    }
  }
  ArcWords arc_words;
  arc_words.plane = state_.plane;
  arc_words.clockwise = movement.motion == MotionMode::arc_clockwise;
  arc_words.centre_is_absolute = state_.arc_distance == DistanceMode::absolute;
  const AxisTarget before = position_.target();
  if (auto done = set_targets(words); !done) return done;
  // Where the height of the start is not known, that of the end stands for it.
  arc_words.end = spatial(position_.target(), Vec3::Zero());
  arc_words.start = spatial(before, arc_words.end);
  for (std::size_t i = 0; i < arc_words.centre.size(); ++i) {
    const char letter = "IJK"[i];
    if (words.has(letter)) arc_words.centre.at(i) = words[letter].value * unit_scale();
  }
  if (words.has('R')) arc_words.radius = words['R'].value * unit_scale();

  auto arc = arc_of(arc_words);
  if (!arc) {
    const LetterSet shape = words.given() & LetterSet(words.has('R') ? "R" : "IJK");
    const std::uint32_t column =
        shape.empty() ? movement.column : words[words.first_of(shape)].column;
    return fail(column, arc.error().front().message, arc.error().front().hint);
  }
  for (const int axis : {axes.u, axes.v}) {
    position_.set(static_cast<AxisLetter>(axis), arc->end[axis]);
  }
  int turns = 1;
  if (words.has('P')) {
    const auto given = whole(words, 'P', 1, kMaxTurns);
    if (!given) return given.error();
    turns = *given;
  }
  const auto feed = feed_for(words, movement, true);
  if (!feed) return feed.error();
  emit(movement.column, ArcFeed{position_.target(), arc->centre, state_.plane,
                                arc_words.clockwise ? -turns : turns, state_.tool_axis, *feed});
  return Done{};
}

double BlockExecutor::unit_scale() const {
  return state_.unit == LengthUnit::inch ? kMmPerInch : 1.0;
}

double BlockExecutor::scaled(AxisLetter axis, double value) const {
  return value * (is_rotary(axis) ? kRadPerDeg : unit_scale());
}

BlockExecutor::Outcome BlockExecutor::set_target(const BlockWords& words, AxisLetter axis) {
  const char letter = to_char(axis);
  const double value = scaled(axis, words[letter].value);
  if (state_.distance == DistanceMode::absolute) {
    position_.set(axis, value);
    return Done{};
  }
  if (!position_[axis]) {
    return fail(words[letter].column,
                fmt::format("{} is incremental, but {}", words.text_of(letter),
                            position_.why_unknown(axis)),
                fmt::format("program {} once in G90 first", letter));
  }
  position_.set(axis, *position_[axis] + value);
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_targets(const BlockWords& words) {
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    if (state_.compensation.tool_vectors) {
      return fail(
          words[rotary].column,
          fmt::format("{} in G43.5, where tool vectors turn the axes", words.text_of(rotary)),
          "give the direction by I J K, or use G43.4");
    }
    state_.tool_axis.reset();
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (!words.has(to_char(axis))) continue;
    if (auto done = set_target(words, axis); !done) return done;
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_tool_axis(const BlockWords& words) {
  const char first = words.first_of(kVectorWords);
  if (first == 0) return Done{};
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(words[rotary].column,
                fmt::format("{} and a tool vector in one block", words.text_of(rotary)),
                "give the direction by I J K or by rotary words, not both");
  }
  state_.tool_axis = UnitVec3::of(Vec3(words['I'].value, words['J'].value, words['K'].value));
  if (!state_.tool_axis) {
    return fail(words[first].column, "the tool vector has no direction",
                "give I J K a length above zero; it points from the tip to the spindle");
  }
  forget(kRotaryWords, PositionLoss::tool_vector);
  return Done{};
}

Result<Feed> BlockExecutor::feed_for(const BlockWords& words, const Movement& movement,
                                     bool linear) const {
  if (state_.feed_mode == FeedMode::inverse_time && !words.has('F')) {
    return fail(movement.column, fmt::format("{} without F in G93", motion_name(movement.motion)),
                "in G93 each cutting block needs its own F, the inverse of its minutes");
  }
  if (!state_.feed) {
    return fail(movement.column,
                fmt::format("{} without a feed rate", motion_name(movement.motion)),
                "give F on this block or before, above zero");
  }
  return Feed{linear ? state_.feed->scaled : state_.feed->as_written, state_.feed_mode};
}

void BlockExecutor::leave_program_coordinates(LetterSet axes, PositionLoss loss) {
  // With the tool-centre-point control on, X Y Z are of the tip, which any axis may carry along.
  forget(state_.tool_centre_point() ? axes | kLinearWords : axes, loss);
  if (!(axes & kRotaryWords).empty()) state_.tool_axis.reset();
}

void BlockExecutor::forget(LetterSet axes, PositionLoss loss) {
  for (const AxisLetter axis : kAxisLetters) {
    if (axes.has(to_char(axis))) position_.forget(axis, loss, line_);
  }
}

}  // namespace frustum::parser

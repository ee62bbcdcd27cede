// The moves of a block: straight lines and arcs, and what they do to the known position. Those to reference points
// and in machine coordinates are in block_points.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxHelixTurns = 10'000;

const char* motion_name(MotionMode motion, Dialect dialect) {
  constexpr std::array kNames{"",    "G0", "G1",   "G2",   "G3",  "CT",
                              "CIP", "G5", "G5.1", "G5.2", "G5.3"};
  constexpr std::array kPlain{"",         "a rapid move", "a cutting move", "an arc",
                              "an arc",   "an arc",       "an arc",         "a spline",
                              "a spline", "a spline",     "a spline"};
  if (is_cycle(motion)) return "a canned cycle";
  if (motion >= MotionMode::probe_towards) return "a probing move";
  const bool letters = dialect != Dialect::heidenhain && dialect != Dialect::cldata;
  return (letters ? kNames : kPlain).at(static_cast<std::size_t>(motion));
}

std::string_view absolute_words(Dialect dialect) {
  return dialect == Dialect::heidenhain ? "without I" : "in absolute coordinates (G90)";
}

// Whether X, Y or Z moves between two targets; an axis first placed now counts as moving.
bool moves_linearly(const AxisTarget& before, const AxisTarget& after) {
  for (const AxisLetter axis : kLinearAxes) {
    if (after[axis] && before[axis] != after[axis]) return true;
  }
  return false;
}

// Of an angle in degrees; a whole turn and a little is one.
int started_turns(double angle) {
  constexpr double kDegreesOfATurn = 360.0;
  constexpr double kRounding = 1e-6;
  const double turns = std::ceil(std::abs(angle) / kDegreesOfATurn - kRounding);
  return static_cast<int>(std::clamp(turns, 1.0, static_cast<double>(kMaxHelixTurns)));
}

Vec3 spatial(const AxisTarget& target, const Vec3& otherwise) {
  Vec3 point = otherwise;
  for (const AxisLetter axis : kLinearAxes) {
    const auto slot = static_cast<Eigen::Index>(axis);
    point[slot] = target[axis].value_or(otherwise[slot]);
  }
  return point;
}

}  // namespace

BlockExecutor::Outcome BlockExecutor::move(const BlockWords& words, const Movement& movement) {
  // Axis words or not, the motion word stays in force for the blocks after.
  state_.motion = motion_of(words);
  if (auto done = check_feature(movement); !done) return done;
  if (!is_cycle(state_.motion)) {
    state_.cycle.reset();
    state_.before_cycle = state_.motion;
  }
  if (auto done = check_open_nurbs(movement); !done) return done;
  const bool stands = movement.motion == MotionMode::none && movement.non_modal == NonModal::none;
  if (!stands && movement.motion != MotionMode::cubic_spline) spline_leads_.reset();
  const bool places = is_cycle(movement.motion) ||
                      (movement.non_modal != NonModal::none &&
                       movement.non_modal != NonModal::dwell && !is_pole(movement.non_modal));
  if (places) {
    radius_exit_ = {};
    arc_waits_for_exit_ = false;
  }
  if (movement.non_modal == NonModal::home) return go_home(words, 1);
  if (movement.non_modal == NonModal::second_home) return go_home(words, 2);
  if (movement.non_modal == NonModal::keep_home) return keep_point(0, movement.column);
  if (movement.non_modal == NonModal::keep_second_home) return keep_point(1, movement.column);
  if (movement.non_modal == NonModal::check_home) return check_home(words);
  if (movement.non_modal == NonModal::from_home) return come_from_home(words);
  if (movement.non_modal == NonModal::data) return set_data(words);
  if (movement.non_modal == NonModal::align) return align(movement.column);
  if (movement.non_modal == NonModal::pole) return set_pole(words);
  if (is_pole(movement.non_modal)) return set_pole_in_plane(words, movement.non_modal);
  if (movement.non_modal == NonModal::start) return set_start(words);
  if (movement.non_modal >= NonModal::shift_to_place) return shift_words(words, movement.non_modal);
  if (movement.motion != MotionMode::none) {
    if (auto done = announce_rotary_paths(words, movement.column); !done) return done;
  }
  if (movement.non_modal == NonModal::machine_coordinates) {
    return move_in_machine_coordinates(words, movement);
  }
  if (is_spline(movement.motion)) return move_along_spline(words, movement);
  if (is_cycle(movement.motion)) return run_cycle(words, movement);
  if (rules_.holes_at_moves && state_.hole_cycle.on && movement.motion != MotionMode::none) {
    return make_hole(words, movement);
  }
  switch (movement.motion) {
    case MotionMode::none:
      return Done{};
    case MotionMode::traverse:
    case MotionMode::linear:
      return move_straight(words, movement);
    case MotionMode::arc_clockwise:
    case MotionMode::arc_counterclockwise:
    case MotionMode::arc_tangential:
      return move_along_arc(words, movement);
    case MotionMode::arc_through:
      return move_through_point(words, movement);
    case MotionMode::thread:
      return move_along_thread(words, movement);
    case MotionMode::rigid_tap:
      return tap_rigidly(words, movement);
    case MotionMode::thread_cycle:
      return cut_thread(words, movement);
    case MotionMode::probe_towards:
    case MotionMode::probe_towards_if_any:
    case MotionMode::probe_away:
    case MotionMode::probe_away_if_any:
      return probe(words, movement);
    default:
      return Done{};
  }
}

BlockExecutor::Outcome BlockExecutor::move_straight(const BlockWords& words,
                                                    const Movement& movement) {
  const AxisTarget before = position_.target();
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = set_targets(words); !done) return done;
  if (auto done = set_tool_axis(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  keep_heading(before);
  const AxisTarget end = leaving_contour(words, end_of(words));
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
  if (arc_waits_for_exit_) {
    return fail(movement.column, "radius-compensation"_id,
                "the first move after radius compensation is an arc",
                "leave the contour by a straight move");
  }
  const PlaneAxes axes = axes_of(state_.plane);
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (!position_[letter]) {
      return fail(
          movement.column, position_.unknown_id(letter),
          fmt::format("the start of the arc is not known: {}", position_.why_unknown(letter)),
          rules_.dialect == Dialect::heidenhain
              ? "move to the start by L before, with X and Y without I"
              : "move to the start with G0 or G1 in G90 first");
    }
  }
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  if (auto done = check_polar_arc(words); !done) return done;
  ArcWords arc_words;
  arc_words.plane = state_.plane;
  arc_words.clockwise = movement.motion == MotionMode::arc_clockwise;
  arc_words.centre_is_absolute = state_.arc_distance == DistanceMode::absolute;
  const AxisTarget before = position_.target();
  if (auto done = set_targets(words); !done) return done;
  if (rules_.vector_letters != "IJK") {
    if (auto done = set_tool_axis(words); !done) return done;
  }
  // Where the height of the start is not known, that of the end stands for it.
  arc_words.end = spatial(position_.target(), Vec3::Zero());
  arc_words.start = spatial(before, arc_words.end);
  for (std::size_t i = 0; i < arc_words.centre.size(); ++i) {
    const char letter = "IJK"[i];
    if (!words.has(letter)) continue;
    const bool absolute = words[letter].measure == Measure::absolute;
    arc_words.centre.at(i) = words[letter].value * unit_scale() -
                             (absolute ? arc_words.start[static_cast<Eigen::Index>(i)] : 0.0);
  }
  const bool polar = rules_.polar.about_pole && words.first_of(LetterSet("pq")) != 0;
  if (words.has(kTangential) || movement.motion == MotionMode::arc_tangential) {
    if (auto done = lead_on(movement, arc_words); !done) return done;
  } else if (polar && !rules_.arcs_turn_about_pole) {
    if (auto done = turn_about_pole(words, movement, arc_words); !done) return done;
  } else if (rules_.arcs_turn_about_pole && !words.has('R')) {
    if (!state_.pole) {
      return fail(movement.column, "arc-centre-missing"_id, "the arc has no centre",
                  "give the centre by CC before");
    }
    arc_words.centre_is_absolute = true;
    arc_words.centre = {state_.pole->at[0], state_.pole->at[1], std::nullopt};
  }
  if (words.has('R')) arc_words.radius = words['R'].value * unit_scale();

  auto arc = arc_of(arc_words);
  if (!arc) {
    const LetterSet shape = words.given() & LetterSet(words.has('R') ? "R" : "IJK");
    const std::uint32_t column =
        shape.empty() ? movement.column : words[words.first_of(shape)].column;
    return fail(column, arc.error().front());
  }
  for (const int axis : {axes.u, axes.v}) {
    position_.set(static_cast<AxisLetter>(axis), arc->end[axis]);
  }
  int turns = 1;
  if (rules_.arcs_turn_about_pole && words[kPolarAngle].measure == Measure::incremental) {
    if (auto done = check_turned_angle(words, arc_words); !done) return done;
    turns = started_turns(words[kPolarAngle].value);
  }
  if (rules_.arcs_lead_on) {
    const Vec3 arm = arc->end - arc->centre;
    const Vec3 along = Vec3::Unit(axes.w).cross(arm) * (arc_words.clockwise ? -1.0 : 1.0);
    state_.heading = Heading{spatial(position_.target(), Vec3::Zero()), along};
  }
  if (words.has('P')) {
    const auto given = whole(words, 'P', 1, kMaxHelixTurns);
    if (!given) return given.error();
    turns = *given;
  }
  if (words.has('e')) {
    const auto more = whole(words, 'e', 0, kMaxHelixTurns);
    if (!more) return more.error();
    turns += *more;
  }
  const auto feed = feed_for(words, movement, true);
  if (!feed) return feed.error();
  emit(movement.column, ArcFeed{end_of(words), arc->centre, state_.plane,
                                arc_words.clockwise ? -turns : turns, state_.tool_axis, *feed});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_start(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  std::string text;
  for (const AxisLetter axis : kLinearAxes) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    position_.set(axis, scaled(axis, words[letter].value));
    text += (text.empty() ? "" : " ") + words.text_of(letter);
  }
  emit(code.column, Event{code.code->name(), std::move(text)});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::check_tool_length(const Movement& movement) const {
  if (!state_.compensation.tip || state_.compensation.length) return Done{};
  return fail(
      movement.column, "tool-length-missing"_id,
      "the tool-tip control is on, but no tool length is in force",
      rules_.tool_brings_length ? "call a tool before the move" : "give G43 H before the move");
}

double BlockExecutor::unit_scale() const {
  return state_.unit == LengthUnit::millimetre ? 1.0 : kMmPerInch;
}

double BlockExecutor::scaled(AxisLetter axis, double value) const {
  const double share = axis == AxisLetter::X && state_.diameter ? 0.5 : 1.0;
  return value * (is_rotary(axis) ? kRadPerDeg : share * unit_scale());
}

BlockExecutor::Outcome BlockExecutor::set_target(const BlockWords& words, AxisLetter axis) {
  const char letter = to_char(axis);
  const double value = scaled(axis, words[letter].value);
  const Measure measure = words[letter].measure;
  const bool absolute = measure == Measure::modal ? state_.distance == DistanceMode::absolute
                                                  : measure != Measure::incremental;
  if (absolute) {
    LetterSet placed;
    placed.add(letter);
    state_.placed_in_other_frame = state_.placed_in_other_frame.without(placed);
    position_.set(axis, value);
    return Done{};
  }
  if (!position_[axis]) {
    return fail(words[letter].column, position_.unknown_id(axis),
                fmt::format("{} is incremental, but {}", words.text_of(letter),
                            position_.why_unknown(axis)),
                fmt::format("program {} once {} first", letter, absolute_words(rules_.dialect)));
  }
  if (state_.placed_in_other_frame.has(letter)) {
    return fail(words[letter].column, "frame-changed"_id,
                fmt::format("{} is incremental, but the frame has changed since {} was programmed",
                            words.text_of(letter), letter),
                fmt::format("program {} once {} first", letter, absolute_words(rules_.dialect)));
  }
  position_.set(axis, *position_[axis] + value);
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_targets(const BlockWords& words) {
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    if (state_.compensation.tool_vectors) {
      return fail(
          words[rotary].column, "rotary-with-vector"_id,
          fmt::format("{} in G43.5, where tool vectors turn the axes", words.text_of(rotary)),
          "give the direction by I J K, or use G43.4");
    }
    state_.tool_axis.reset();
  }
  if (auto done = rules_.polar.about_pole ? set_target_about_pole(words) : set_polar_target(words);
      !done) {
    return done;
  }
  if (auto done = set_place_in_plane(words); !done) return done;
  const PlaneAxes plane = axes_of(state_.plane);
  for (const AxisLetter axis : kAxisLetters) {
    if (!words.has(to_char(axis))) continue;
    if (axis == static_cast<AxisLetter>(plane.u) || axis == static_cast<AxisLetter>(plane.v))
      continue;
    if (auto done = set_target(words, axis); !done) return done;
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_tool_axis(const BlockWords& words) {
  const char first = words.first_of(LetterSet(rules_.vector_letters));
  if (auto done = check_orientation_reference(words); !done) return done;
  if (first == 0) return Done{};
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(words[rotary].column, "rotary-with-vector"_id,
                fmt::format("{} and a tool vector in one block", words.text_of(rotary)),
                fmt::format("give the direction by {} or by rotary words, not both",
                            rules_.vector_spelling));
  }
  state_.tool_axis = UnitVec3::of(vector_of(words, rules_.vector_letters));
  if (!state_.tool_axis) {
    return fail(words[first].column, "vector-zero"_id, "the tool vector has no direction",
                fmt::format("give {} a length above zero; it points from the tip to the spindle",
                            rules_.vector_spelling));
  }
  forget(kRotaryWords, PositionLoss::tool_vector);
  return Done{};
}

Result<Feed> BlockExecutor::feed_for(const BlockWords& words, const Movement& movement,
                                     bool linear) const {
  if (words.has('t')) {
    if (words['t'].value <= 0.0) {
      return fail(words['t'].column, "value-not-positive"_id,
                  fmt::format("{} is not above zero", words.text_of('t')),
                  "give the time of the block in seconds");
    }
    return Feed{kSecondsPerMinute / words['t'].value, FeedMode::inverse_time};
  }
  if (state_.feed_mode == FeedMode::inverse_time && !words.has('F')) {
    return fail(movement.column, "feed-missing"_id,
                fmt::format("{} without F in G93", motion_name(movement.motion, rules_.dialect)),
                "in G93 each cutting block needs its own F, the inverse of its minutes");
  }
  if (!state_.feed) {
    return fail(movement.column, "feed-missing"_id,
                fmt::format("{} without a feed rate", motion_name(movement.motion, rules_.dialect)),
                "give F on this block or before, above zero");
  }
  return Feed{linear ? state_.feed->scaled : state_.feed->as_written, state_.feed_mode};
}

void BlockExecutor::forget(LetterSet axes, PositionLoss loss) {
  for (const AxisLetter axis : kAxisLetters) {
    if (axes.has(to_char(axis))) position_.forget(axis, loss, block_->line);
  }
  // Moves of the machine leave a pole in the words' frame.
  const bool stays = rules_.polar.origin_is_pole && loss != PositionLoss::work_offset &&
                     loss != PositionLoss::tilted_plane && loss != PositionLoss::turned_frame;
  if (axes.has('X') && !stays) lose_pole();
}

}  // namespace frustum::parser

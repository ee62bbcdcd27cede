#include "parser/interpret/moves/straight_and_arc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/constants.hpp"
#include "parser/arc.hpp"
#include "parser/arc_feed.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/angle_words.hpp"
#include "parser/interpret/moves/arc_chords.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/polar_words.hpp"
#include "parser/interpret/moves/pole.hpp"
#include "parser/interpret/moves/reference_points.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxHelixTurns = 10'000;

// Whether X, Y or Z moves between two targets; an axis first placed now counts as moving.
bool moves_linearly(const AxisTarget& before, const AxisTarget& after) {
  for (const AxisLetter axis : kLinearAxes) {
    if (after[axis] && before[axis] != after[axis]) return true;
  }
  return false;
}

// The F of a move that turns rotary axes alone counts degrees.
bool feeds_along(const AxisTarget& before, const AxisTarget& after, bool turns_tool) {
  if (moves_linearly(before, after)) return true;
  if (turns_tool) return false;
  return std::ranges::none_of(
      kRotaryAxes, [&](AxisLetter axis) { return after[axis] && before[axis] != after[axis]; });
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

// Neither centre nor radius.
bool lacks_centre(const BlockWords& words, PlaneAxes axes) {
  return !words.has('R') && !words.has("IJK"[axes.u]) && !words.has("IJK"[axes.v]);
}

// I J K are the centre itself on some controls. The first arc of a program shows it where its radii
// agree so, and by far not as steps from the start. Radii that nearly agree make a spiral.
Result<Arc> arc_of_iso(InterpreterState& state, const Movement& movement, const ArcWords& words) {
  constexpr double kFar = 0.1;          // mm
  constexpr double kSmallRadius = 1.0;  // mm: of a smaller arc it is too much
  auto arc = arc_of(words);
  if (words.radius) return arc;
  const bool first = !std::exchange(state.modes.centres_are_known, true);
  if (arc) return arc;
  ArcWords lenient = words;
  lenient.tolerance = {.absolute = kFar, .relative = 0.0, .largest = kFar};
  auto nearly = arc_of(lenient);
  // A full circle closes about any centre.
  if (first && (words.end - words.start).norm() >= kFar) {
    ArcWords itself = words;
    itself.centre_is_absolute = true;
    itself.tolerance = {.relative = 0.0, .largest = itself.tolerance.absolute};
    auto otherwise = arc_of(itself);
    if (otherwise && nearly) return arc;
    if (otherwise) {
      state.modes.arc_distance = DistanceMode::absolute;
      assume(state, movement.column, "arc centres",
             "I J K are the centre itself, as the radii of the first arc agree only so");
      return otherwise;
    }
  }
  if (!nearly || (nearly->centre - words.start).norm() < kSmallRadius) return arc;
  assume(state, movement.column, "arc radii",
         fmt::format("the control takes radii of an arc that differ by up to {} mm for a spiral",
                     kFar));
  return nearly;
}

// K of a helix in G17: the pitch, which the end along Z repeats. Where they differ it is none.
Outcome check_pitch(InterpreterState& state, const BlockWords& words, const ArcWords& arc,
                    const Vec3& centre, int turns) {
  constexpr double kRounding = 0.002;        // mm, of K in each turn
  constexpr double kRoundingOfInches = 2.5;  // times as much
  const PlaneAxes axes = axes_of(arc.plane);
  const char letter = "IJK"[axes.w];
  if (state.rules.dialect != Dialect::fanuc || words.has('R') || words[letter].value == 0.0) {
    return Done{};
  }
  const auto angle_of = [&](const Vec3& point) {
    const double angle = std::atan2(point[axes.v] - centre[axes.v], point[axes.u] - centre[axes.u]);
    return arc.clockwise ? -angle : angle;
  };
  double angle = std::remainder(angle_of(arc.end) - angle_of(arc.start), kTurn);
  if (angle <= 1e-9) angle += kTurn;
  const double parts = angle / kTurn + (turns - 1);
  const double rise = std::abs(arc.end[axes.w] - arc.start[axes.w]);
  const double pitch = std::abs(length_of(state, words[letter].value));
  const double rounding =
      kRounding * turns * (state.modes.unit == LengthUnit::millimetre ? 1.0 : kRoundingOfInches);
  if (std::abs(rise - pitch * parts) > rounding) {
    return fail(state, words[letter].column, "word-unused"_id,
                fmt::format("{} has no meaning in this block", words.text_of(letter)),
                fmt::format("the pitch of the helix is {:.6g} mm", rise / parts));
  }
  assume(state, words[letter].column, "pitch",
         fmt::format("{} is the pitch of the helix, which agrees with its end",
                     words.text_of(letter)));
  return Done{};
}

// Full turns are before the way to the end. TURN=1.5 of some posts has a half where the way to the
// end is half a turn.
bool is_share(InterpreterState& state, const BlockWords& words, const ArcWords& given,
              const Arc& arc) {
  constexpr double kSame = 1e-3;  // of a turn
  const double share = words['e'].value - std::floor(words['e'].value);
  if (share == 0.0 || words['e'].value < 0.0 || words['e'].value > kMaxHelixTurns) return false;
  const PlaneAxes axes = axes_of(given.plane);
  const auto heading = [&](const Vec3& point) {
    return std::atan2(point[axes.v] - arc.centre[axes.v], point[axes.u] - arc.centre[axes.u]);
  };
  const double turned = (heading(arc.end) - heading(given.start)) / kTurn;
  const double swept = given.clockwise ? -turned : turned;
  if (std::abs(swept - std::floor(swept) - share) > kSame) return false;
  assume(state, words['e'].column, "TURN",
         "the part of a turn is the way to the end, which comes after the whole turns");
  return true;
}

// Behind G40 the tool stays beside the contour until a move in the plane.
AxisTarget leaving_contour(InterpreterState& state, const BlockWords& words, AxisTarget end) {
  const bool polar = !(words.given() & state.rules.polar_words).empty();
  bool leaves = polar || state.rules.radius.any_move_leaves;
  for (const AxisLetter axis : kAxisLetters) {
    if (state.contour_exit.place[axis] && words.has(to_char(axis))) leaves = true;
  }
  if (leaves) {
    state.contour_exit.place = {};
    state.contour_exit.arc_waits = false;
    return end;
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (state.contour_exit.place[axis]) end[axis] = state.contour_exit.place[axis];
  }
  return end;
}

// Of Klartext the plane of the pole, or of the coordinates of CR, whatever the tool's axis is.
Plane plane_of_arc(const InterpreterState& state, const BlockWords& words) {
  if (!state.rules.arcs_turn_about_pole || words.has(kTangential)) return state.modes.plane;
  if (!words.has('R')) return state.modes.pole ? state.modes.pole->plane : state.modes.plane;
  if (!words.has('Z') || words.has('X') == words.has('Y')) return state.modes.plane;
  return words.has('X') ? Plane::zx : Plane::yz;
}

// Polar places of Klartext are in the plane of their pole.
Plane plane_of_line(const InterpreterState& state, const BlockWords& words) {
  const bool polar = state.rules.arcs_turn_about_pole && words.first_of(LetterSet("pq")) != 0;
  return polar && state.modes.pole ? state.modes.pole->plane : state.modes.plane;
}

// F of an arc as Fanuc has it.
void count_feed_in_plane(InterpreterState& state, const Movement& movement,
                         const AxisTarget& before, ArcFeed& arc) {
  constexpr double kSameFeed = 1e-9;  // of the feed
  const double factor = canonical_of_fanuc_feed(arc, before);
  if (arc.feed.value == 0.0 || std::abs(factor - 1.0) <= kSameFeed) return;
  arc.feed.value *= factor;
  if (arc.feed.mode == FeedMode::inverse_time) {
    assume(state, movement.column, "arc in G93",
           "F of an arc is its speed over its radius, as Fanuc and Mitsubishi have it; on Haas it "
           "is the inverse of its minutes");
  } else {
    assume(
        state, movement.column, "helix feed",
        "F of a helix is the speed along its arc in the plane, as parameter 1401#2 (HTG) = 0 has "
        "it");
  }
}

// The plane of one block.
class PlaneOfBlock {
 public:
  PlaneOfBlock(ModalState& modes, Plane plane) : modes_(modes), kept_(modes.plane) {
    modes.plane = plane;
  }
  PlaneOfBlock(const PlaneOfBlock&) = delete;
  PlaneOfBlock& operator=(const PlaneOfBlock&) = delete;
  ~PlaneOfBlock() { modes_.plane = kept_; }

 private:
  ModalState& modes_;
  Plane kept_;
};

}  // namespace

Outcome move_straight(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  if (steps_by_axes(state, words)) return step_axes(state, words, movement);
  const AxisTarget before = state.position.target();
  const PlaneOfBlock plane(state.modes, plane_of_line(state, words));
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (words.has(kHeading) && state.rules.dialect == Dialect::sinumerik) {
    if (auto done = end_at_angle(state, words, before); !done) return done;
  }
  if (auto done = set_tool_axis(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  keep_heading(state, before);
  const AxisTarget end = leaving_contour(state, words, end_of(state, words));
  if (movement.motion == MotionMode::traverse) {
    emit(state, movement.column, Traverse{end, state.modes.tool_axis, Coordinates::program});
    return Done{};
  }
  const bool turns_tool = words.first_of(LetterSet(state.rules.vector_letters)) != 0;
  const auto feed = feed_for(state, words, movement, feeds_along(before, end, turns_tool));
  if (!feed) return feed.error();
  emit(state, movement.column, LinearFeed{end, state.modes.tool_axis, Coordinates::program, *feed});
  return Done{};
}

Outcome move_along_arc(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  if (state.contour_exit.arc_waits) {
    return fail(state, movement.column, "radius-compensation"_id,
                "the first move after radius compensation is an arc",
                "leave the contour by a straight move");
  }
  const PlaneOfBlock plane(state.modes, plane_of_arc(state, words));
  const PlaneAxes axes = axes_of(state.modes.plane);
  if (state.rules.arcs_may_lack_centre && lacks_centre(words, axes)) {
    assume(state, movement.column, "arc without centre",
           "neither a centre nor R: the tool goes straight to the end");
    return move_straight(state, words, {movement.non_modal, MotionMode::linear, movement.column});
  }
  for (const int axis : {axes.u, axes.v}) {
    const auto letter = static_cast<AxisLetter>(axis);
    if (!state.position[letter]) {
      return fail(
          state, movement.column, state.position.unknown_id(letter),
          fmt::format("the start of the arc is not known: {}", state.position.why_unknown(letter)),
          state.rules.dialect == Dialect::heidenhain
              ? "move to the start by L before, with X and Y without I"
              : "move to the start with G0 or G1 in G90 first");
    }
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  if (auto done = check_polar_arc(state, words); !done) return done;
  const std::string radius_word = words.has('R')                              ? words.name_of('R')
                                  : state.rules.dialect == Dialect::sinumerik ? "CR"
                                                                              : "R";
  ArcWords arc_words;
  arc_words.radius_word = radius_word;
  arc_words.plane = state.modes.plane;
  const bool inches = state.modes.unit != LengthUnit::millimetre && state.rules.arcs_in_inches;
  arc_words.tolerance = inches ? *state.rules.arcs_in_inches : state.rules.arcs;
  arc_words.clockwise = movement.motion == MotionMode::arc_clockwise;
  arc_words.centre_is_absolute = state.modes.arc_distance == DistanceMode::absolute;
  const AxisTarget before = state.position.target();
  if (auto done = set_targets(state, words); !done) return done;
  if (state.rules.vector_letters != "IJK") {
    if (auto done = set_tool_axis(state, words); !done) return done;
  }
  // Where the height of the start is not known, that of the end represents it.
  arc_words.end = spatial(state.position.target(), Vec3::Zero());
  arc_words.start = spatial(before, arc_words.end);
  for (std::size_t i = 0; i < arc_words.centre.size(); ++i) {
    const char letter = "IJK"[i];
    if (!words.has(letter) || (state.rules.arcs_may_lack_centre && words.has('R'))) continue;
    const bool absolute = words[letter].measure == Measure::absolute;
    arc_words.centre.at(i) = length_of(state, words[letter].value) -
                             (absolute ? arc_words.start[static_cast<Eigen::Index>(i)] : 0.0);
  }
  const bool polar = state.rules.polar.about_pole && words.first_of(LetterSet("pq")) != 0;
  if (words.has(kTangential) || movement.motion == MotionMode::arc_tangential) {
    if (auto done = lead_on(state, movement, arc_words); !done) return done;
  } else if (polar && !state.rules.arcs_turn_about_pole) {
    if (auto done = turn_about_pole(state, words, movement, arc_words); !done) return done;
  } else if (state.rules.arcs_turn_about_pole && !words.has('R')) {
    if (!state.modes.pole) {
      return fail(state, movement.column, "arc-centre-missing"_id, "the arc has no centre",
                  "give the centre by CC before");
    }
    arc_words.centre_is_absolute = true;
    arc_words.centre = {};
    for (const int axis : {axes.u, axes.v}) {
      arc_words.centre.at(static_cast<std::size_t>(axis)) = state.modes.pole->at[axis];
    }
  }
  if (words.has('R')) arc_words.radius = length_of(state, words['R'].value);
  if (words.has(kOpening) && state.rules.dialect == Dialect::sinumerik) {
    if (auto done = open_arc(state, words, arc_words); !done) return done;
  }

  auto arc = state.rules.first_arc_shows_centre ? arc_of_iso(state, movement, arc_words)
                                                : arc_of(arc_words);
  if (!arc) {
    const LetterSet shape = words.given() & LetterSet(words.has('R') ? "R" : "IJK");
    const std::uint32_t column =
        shape.empty() ? movement.column : words[words.first_of(shape)].column;
    return fail(state, column, arc.error().front());
  }
  for (const int axis : {axes.u, axes.v}) {
    state.position.set(static_cast<AxisLetter>(axis), arc->end[axis]);
  }
  int turns = 1;
  if (state.rules.arcs_turn_about_pole && words[kPolarAngle].measure == Measure::incremental) {
    constexpr double kHalfTurn = 180.0;  // both ways round end at the same place
    const double angle = words[kPolarAngle].value;
    if (angle != 0.0 && std::fmod(angle, kHalfTurn) == 0.0) {
      if ((angle < 0.0) != arc_words.clockwise) {
        assume(state, words[kPolarAngle].column, "CP",
               "DR says which way round a whole or a half turn goes");
      }
    } else if (auto done = check_turned_angle(state, words, arc_words); !done) {
      return done;
    }
    turns = started_turns(words[kPolarAngle].value);
  }
  if (state.rules.arcs_lead_on) {
    const Vec3 arm = arc->end - arc->centre;
    const Vec3 along = Vec3::Unit(axes.w).cross(arm) * (arc_words.clockwise ? -1.0 : 1.0);
    state.modes.heading = Heading{spatial(state.position.target(), Vec3::Zero()), along};
  }
  if (words.has('P')) {
    const auto given = whole(state, words, 'P', 1, kMaxHelixTurns);
    if (!given) return given.error();
    turns = *given;
  }
  if (words.has('e') && is_share(state, words, arc_words, *arc)) {
    turns += static_cast<int>(words['e'].value);
  } else if (words.has('e')) {
    const auto more = whole(state, words, 'e', 0, kMaxHelixTurns);
    if (!more) return more.error();
    turns += *more;
  }
  if (auto done = check_pitch(state, words, arc_words, arc->centre, turns); !done) return done;
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  ArcFeed move{end_of(state, words),  arc->centre,
               state.modes.plane,     arc_words.clockwise ? -turns : turns,
               state.modes.tool_axis, *feed};
  if (state.rules.arc_feed_is_in_plane) count_feed_in_plane(state, movement, before, move);
  if (!state.modes.programmed_frame.keeps(state.modes.plane) ||
      !state.modes.offset_frame.keeps(state.modes.plane)) {
    return cut_arc_into_chords(state, movement, before, move);
  }
  emit(state, movement.column, move);
  return Done{};
}

}  // namespace frustum::parser

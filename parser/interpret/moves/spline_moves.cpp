#include "parser/interpret/moves/spline_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parser/arc.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/moves/spline.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// A hundredth of a micrometre: a thousandth of what a machine of ISO 10791-7 shows.
constexpr double kTolerance = 1e-5;  // mm
constexpr int kLeastOrder = 3;

constexpr int kMostOrder = 30;

// Weights further apart leave no digits to the points between them.
constexpr double kMostWeight = 1e6;

constexpr const char* kEndKnots = "end it with as many equal knots K as its order P";

// A move shorter than every control's increment is none.
constexpr double kNoWay = 1e-9;  // mm

// "X and Y"
std::string axes_of_spline(const InterpreterState& state) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  return fmt::format("{} and {}", "XYZ"[std::min(axes.u, axes.v)], "XYZ"[std::max(axes.u, axes.v)]);
}

Outcome check_spline(const InterpreterState& state, const BlockWords& words,
                     const Movement& movement) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  LetterSet others = kRotaryWords;
  others.add("XYZ"[axes.w]);
  if (const char letter = words.first_of(others); letter != 0) {
    return fail(state, words[letter].column, "spline-axes"_id,
                fmt::format("{} in a spline", words.text_of(letter)),
                fmt::format("a spline moves {} only", axes_of_spline(state)));
  }
  if (state.contour_exit.arc_waits) {
    return fail(state, movement.column, "radius-compensation"_id,
                "the first move after radius compensation is a spline",
                "leave the contour by a straight move");
  }
  for (const int index : {axes.u, axes.v}) {
    const auto axis = static_cast<AxisLetter>(index);
    if (state.position[axis]) continue;
    return fail(
        state, movement.column, state.position.unknown_id(axis),
        fmt::format("the start of the spline is not known: {}", state.position.why_unknown(axis)),
        "move to the start with G0 or G1 in G90 first");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  return check_programmed_frame(state, movement);
}

Vec2 place_in_plane(const InterpreterState& state) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  return {*state.position[static_cast<AxisLetter>(axes.u)],
          *state.position[static_cast<AxisLetter>(axes.v)]};
}

// Of two words that lead along the axes of the plane in the order of the letters X, Y, Z.
Vec2 way_of(const InterpreterState& state, const BlockWords& words, char first, char second) {
  const Vec2 way{length_of(state, words[first].value), length_of(state, words[second].value)};
  return state.modes.plane == Plane::zx ? Vec2(way.y(), way.x()) : way;
}

// Steps count from where the tool is before the spline.
Outcome place_point(InterpreterState& state, const BlockWords& words) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const Vec2& from = state.spline.nurbs->from;
  state.position.set(static_cast<AxisLetter>(axes.u), from.x());
  state.position.set(static_cast<AxisLetter>(axes.v), from.y());
  if (auto done = set_targets(state, words); !done) return done;
  return Done{};
}

Outcome trace_spline(InterpreterState& state, const BlockWords& words, const Movement& movement,
                     std::span<const ControlPoint> points, int order,
                     std::span<const double> knots = {}) {
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  const std::vector<PathPiece> pieces = arcs_of_spline(points, order, kTolerance, knots);
  emit(state, movement.column,
       Event{"spline", fmt::format("{} control points, {} moves within {:g} mm", points.size(),
                                   pieces.size(), kTolerance)});
  double length = 0.0;
  for (const PathPiece& piece : pieces) length += length_of(piece);
  AxisTarget end = end_of(state, words);
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  Vec3 centre = Vec3::Zero();
  centre[axes.w] = state.position[static_cast<AxisLetter>(axes.w)].value_or(0.0);
  for (const PathPiece& piece : pieces) {
    end[u] = piece.end.x();
    end[v] = piece.end.y();
    Feed share = *feed;
    if (share.mode == FeedMode::inverse_time) share.value *= length / length_of(piece);
    if (piece.is_arc()) {
      centre[axes.u] = piece.centre.x();
      centre[axes.v] = piece.centre.y();
      emit(state, movement.column,
           ArcFeed{end, centre, state.modes.plane, piece.turns, state.modes.tool_axis, share});
    } else {
      emit(state, movement.column,
           LinearFeed{end, state.modes.tool_axis, Coordinates::program, share});
    }
  }
  return Done{};
}

Outcome move_along_cubic(InterpreterState& state, const BlockWords& words,
                         const Movement& movement) {
  const auto needs = [&](char given, std::string_view both, std::string_view what) {
    const std::uint32_t column = given != 0 ? words[given].column : movement.column;
    return fail(state, column, "spline-word-missing"_id, fmt::format("G5 without {}", both),
                std::string(what));
  };
  if (!words.has('P') || !words.has('Q')) {
    return needs(words.first_of(LetterSet("PQ")), "P and Q",
                 "P and Q lead from the end to the second control point");
  }
  const bool has_first = words.has('I') && words.has('J');
  if (!has_first && (words.has('I') || words.has('J') || !state.spline.leads)) {
    return needs(words.first_of(LetterSet("IJ")), "I and J",
                 "I and J lead from the start to the first control point; both may be left out "
                 "after another G5");
  }
  const Vec2 first = has_first ? way_of(state, words, 'I', 'J') : *state.spline.leads;
  const Vec2 second = way_of(state, words, 'P', 'Q');
  const Vec2 start = place_in_plane(state);
  if (auto done = set_targets(state, words); !done) return done;
  const Vec2 end = place_in_plane(state);
  state.spline.leads = -second;
  const std::array points{ControlPoint{start}, ControlPoint{start + first},
                          ControlPoint{end + second}, ControlPoint{end}};
  return trace_spline(state, words, movement, points, static_cast<int>(points.size()));
}

Outcome move_along_quadratic(InterpreterState& state, const BlockWords& words,
                             const Movement& movement) {
  if (!words.has('I') || !words.has('J')) {
    const char given = words.first_of(LetterSet("IJ"));
    return fail(state, given != 0 ? words[given].column : movement.column, "spline-word-missing"_id,
                "G5.1 without I and J",
                "I and J lead from the start to the control point; give both");
  }
  const Vec2 start = place_in_plane(state);
  const Vec2 middle = start + way_of(state, words, 'I', 'J');
  if (auto done = set_targets(state, words); !done) return done;
  const std::array points{ControlPoint{start}, ControlPoint{middle},
                          ControlPoint{place_in_plane(state)}};
  return trace_spline(state, words, movement, points, static_cast<int>(points.size()));
}

Outcome check_weight(const InterpreterState& state, const BlockWords& words, char letter) {
  const double weight = words[letter].value;
  if (!words.has(letter) || (weight >= 1.0 / kMostWeight && weight <= kMostWeight)) return Done{};
  return fail(state, words[letter].column, "out-of-range"_id,
              fmt::format("the weight {} is out of range", words.text_of(letter)),
              fmt::format("weights go from {:g} to {:g}", 1.0 / kMostWeight, kMostWeight));
}

// How many axes of the plane the block names.
int axes_given(const InterpreterState& state, const BlockWords& words) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  return (words.has("XYZ"[axes.u]) ? 1 : 0) + (words.has("XYZ"[axes.v]) ? 1 : 0);
}

Diagnostic without_place(const InterpreterState& state, const Movement& movement) {
  return fail(state, movement.column, "spline-word-missing"_id,
              fmt::format("a control point without {}", axes_of_spline(state)), "give both");
}

Outcome add_nurbs_point(InterpreterState& state, const BlockWords& words,
                        const Movement& movement) {
  const bool first = !state.spline.nurbs;
  if (auto done = check_weight(state, words, 'P'); !done) return done;
  int order = first ? kLeastOrder : state.spline.nurbs->order;
  if (words.has('L')) {
    const auto given = whole(state, words, 'L', kLeastOrder, kMostOrder);
    if (!given) return given.error();
    order = *given;
  }
  const double weight = words.has('P') ? words['P'].value : 1.0;
  if (first)
    state.spline.nurbs = SplineInProgress::Nurbs{state.at_work.place_of(movement.column),
                                                 order,
                                                 {{place_in_plane(state), weight}},
                                                 place_in_plane(state)};
  state.spline.nurbs->order = order;
  const int given = axes_given(state, words);
  if (first && given == 0) return Done{};
  if (given < 2) return without_place(state, movement);
  if (!first && !words.has('P')) {
    return fail(state, movement.column, "spline-word-missing"_id,
                "a control point without a weight",
                "give P above zero in each block of the spline, P1 for all alike");
  }
  if (auto done = place_point(state, words); !done) return done;
  state.spline.nurbs->points.push_back({place_in_plane(state), weight});
  return Done{};
}

Outcome move_along_nurbs(InterpreterState& state, const BlockWords& words,
                         const Movement& movement) {
  state.modes.motion = MotionMode::none;
  if (!state.spline.nurbs) {
    return fail(state, movement.column, "spline-not-begun"_id, "G5.3 without G5.2",
                "begin the spline with G5.2 and its control points");
  }
  const SplineInProgress::Nurbs nurbs = *std::exchange(state.spline.nurbs, std::nullopt);
  if (static_cast<int>(nurbs.points.size()) < nurbs.order) {
    return fail(
        state, movement.column, "spline-points"_id,
        fmt::format("{} control points for a spline of order {}", nurbs.points.size(), nurbs.order),
        "give at least as many points as its order L; the first is where the tool is");
  }
  return trace_spline(state, words, movement, nurbs.points, nurbs.order);
}

// The feed to the first control point, and the spline.
Outcome trace_from(InterpreterState& state, const BlockWords& words, const Movement& movement,
                   const SplineInProgress::Nurbs& spline) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto arrive = [&](const Vec2& place) {
    state.position.set(static_cast<AxisLetter>(axes.u), place.x());
    state.position.set(static_cast<AxisLetter>(axes.v), place.y());
  };
  const Vec2& first = spline.points.front().place;
  arrive(first);
  if ((first - spline.from).norm() > kNoWay) {
    const auto feed = feed_for(state, words, movement, true);
    if (!feed) return feed.error();
    emit(state, movement.column,
         LinearFeed{end_of(state, words), state.modes.tool_axis, Coordinates::program, *feed});
  }
  arrive(spline.points.back().place);
  return trace_spline(state, words, movement, spline.points, spline.order, spline.knots);
}

// G6.2: each block has a knot K and, but for the last ones, a control point of the weight R. The
// spline ends with as many equal knots as its order P.
Outcome add_knot(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const auto missing = [&](std::string_view what, std::string_view hint) {
    return fail(state, movement.column, "spline-word-missing"_id, std::string(what),
                std::string(hint));
  };
  if (auto done = check_weight(state, words, 'R'); !done) return done;
  if (!state.spline.nurbs) {
    if (!words.has('P') || !words.has('Q')) {
      return missing("G6.2 begins without P and Q",
                     "give the order of the spline by P, and how the "
                     "control is to trace it by Q: 1, 2 or 3");
    }
    const auto order = whole(state, words, 'P', 2, kMostOrder);
    if (!order) return order.error();
    // How the control makes moves of it, which are the same curve.
    const auto way = whole(state, words, 'Q', 1, 3);
    if (!way) return way.error();
    state.spline.nurbs = SplineInProgress::Nurbs{
        state.at_work.place_of(movement.column), *order, {}, place_in_plane(state)};
  }
  SplineInProgress::Nurbs& nurbs = *state.spline.nurbs;
  if (!words.has('K')) return missing("a block of G6.2 without K", "give the knot by K");
  const double knot = words['K'].value;
  if (!nurbs.knots.empty() && knot < nurbs.knots.back()) {
    return fail(state, words['K'].column, "spline-knots"_id,
                fmt::format("the knot {} is below the one before it", words.text_of('K')),
                "knots never go down");
  }
  const int given = axes_given(state, words);
  if (given == 1) return without_place(state, movement);
  const auto order = static_cast<std::size_t>(nurbs.order);
  if (given == 2) {
    if (!words.has('R')) {
      return missing("a control point without a weight", "give R above zero, R1 for all alike");
    }
    if (auto done = place_point(state, words); !done) return done;
    nurbs.points.push_back({place_in_plane(state), words['R'].value});
  }
  nurbs.knots.push_back(knot);
  const std::size_t knots = nurbs.knots.size();
  if (knots <= order || knot != nurbs.knots[knots - order]) return Done{};
  state.modes.motion = MotionMode::none;
  SplineInProgress::Nurbs whole = *std::exchange(state.spline.nurbs, std::nullopt);
  if (whole.points.size() < std::max(knots - order, order)) {
    return fail(state, movement.column, "spline-points"_id,
                fmt::format("{} control points for {} knots of a spline of order {}",
                            whole.points.size(), knots, order),
                "there are as many knots as control points and the order together");
  }
  if (whole.knots.front() != whole.knots[order - 1]) {
    return fail(state, movement.column, "not-simulated"_id,
                "a spline whose first knots are not all alike is not simulated",
                fmt::format("begin it with {} equal knots", order));
  }
  whole.points.resize(knots - order);
  return trace_from(state, words, movement, whole);
}

}  // namespace

Outcome move_along_spline(InterpreterState& state, const BlockWords& words,
                          const Movement& movement) {
  if (auto done = check_spline(state, words, movement); !done) return done;
  switch (movement.motion) {
    case MotionMode::cubic_spline:
      return move_along_cubic(state, words, movement);
    case MotionMode::quadratic_spline:
      return move_along_quadratic(state, words, movement);
    case MotionMode::nurbs:
      return add_nurbs_point(state, words, movement);
    case MotionMode::nurbs_by_knots:
      return add_knot(state, words, movement);
    default:
      return move_along_nurbs(state, words, movement);
  }
}

Outcome check_open_nurbs(const InterpreterState& state, const Movement& movement) {
  if (!state.spline.nurbs) return Done{};
  const bool by_knots = !state.spline.nurbs->knots.empty();
  const bool goes_on =
      by_knots ? movement.motion == MotionMode::nurbs_by_knots
               : movement.motion == MotionMode::nurbs || movement.motion == MotionMode::nurbs_end;
  const bool moves = movement.motion != MotionMode::none && !goes_on;
  const bool places = movement.non_modal != NonModal::none && movement.non_modal != NonModal::dwell;
  if (!moves && !places) return Done{};
  return fail(state, movement.column, "spline-open"_id,
              fmt::format("a move between the points of the spline that {} began on line {}",
                          by_knots ? "G6.2" : "G5.2", state.spline.nurbs->place.line),
              by_knots ? kEndKnots : "end the spline with G5.3 before");
}

std::optional<Diagnostic> spline_without_end(const InterpreterState& state) {
  if (!state.spline.nurbs) return std::nullopt;
  Diagnostic failure =
      state.spline.nurbs->knots.empty()
          ? error("spline-open"_id, "the spline that G5.2 begins has no G5.3", "end it with G5.3")
          : error("spline-open"_id, "the spline that G6.2 begins has no end", kEndKnots);
  failure.line = static_cast<int>(state.spline.nurbs->place.line);
  failure.column = static_cast<int>(state.spline.nurbs->place.column);
  return failure;
}

}  // namespace frustum::parser

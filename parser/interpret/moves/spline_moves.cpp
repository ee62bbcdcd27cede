#include "parser/interpret/moves/spline_moves.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

Outcome check_spline(const InterpreterState& state, const BlockWords& words,
                     const Movement& movement) {
  if (state.modes.plane != Plane::xy) {
    return fail(state, movement.column, "spline-plane"_id, "a spline outside G17",
                "splines are in the plane XY: G17");
  }
  if (const char letter = words.first_of(LetterSet("ZABC")); letter != 0) {
    return fail(state, words[letter].column, "spline-axes"_id,
                fmt::format("{} in a spline", words.text_of(letter)),
                "a spline moves X and Y only");
  }
  if (state.contour_exit.arc_waits) {
    return fail(state, movement.column, "radius-compensation"_id,
                "the first move after radius compensation is a spline",
                "leave the contour by a straight move");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
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
  return {*state.position[AxisLetter::X], *state.position[AxisLetter::Y]};
}

Outcome trace_spline(InterpreterState& state, const BlockWords& words, const Movement& movement,
                     std::span<const ControlPoint> points, int order) {
  const auto feed = feed_for(state, words, movement, true);
  if (!feed) return feed.error();
  const std::vector<PathPiece> pieces = arcs_of_spline(points, order, kTolerance);
  emit(state, movement.column,
       Event{"spline", fmt::format("{} control points, {} moves within {:g} mm", points.size(),
                                   pieces.size(), kTolerance)});
  double length = 0.0;
  for (const PathPiece& piece : pieces) length += length_of(piece);
  AxisTarget end = end_of(state, words);
  const double height = state.position[AxisLetter::Z].value_or(0.0);
  for (const PathPiece& piece : pieces) {
    end[AxisLetter::X] = piece.end.x();
    end[AxisLetter::Y] = piece.end.y();
    Feed share = *feed;
    if (share.mode == FeedMode::inverse_time) share.value *= length / length_of(piece);
    if (piece.is_arc()) {
      emit(state, movement.column,
           ArcFeed{end, Vec3(piece.centre.x(), piece.centre.y(), height), Plane::xy, piece.turns,
                   state.modes.tool_axis, share});
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
  const double scale = unit_scale(state);
  const Vec2 first =
      has_first ? Vec2(words['I'].value, words['J'].value) * scale : *state.spline.leads;
  const Vec2 second = Vec2(words['P'].value, words['Q'].value) * scale;
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
  const Vec2 middle = start + Vec2(words['I'].value, words['J'].value) * unit_scale(state);
  if (auto done = set_targets(state, words); !done) return done;
  const std::array points{ControlPoint{start}, ControlPoint{middle},
                          ControlPoint{place_in_plane(state)}};
  return trace_spline(state, words, movement, points, static_cast<int>(points.size()));
}

Outcome add_nurbs_point(InterpreterState& state, const BlockWords& words,
                        const Movement& movement) {
  const bool first = !state.spline.nurbs;
  if (words.has('P') &&
      !(words['P'].value >= 1.0 / kMostWeight && words['P'].value <= kMostWeight)) {
    return fail(state, words['P'].column, "out-of-range"_id,
                fmt::format("the weight {} is out of range", words.text_of('P')),
                fmt::format("weights go from {:g} to {:g}", 1.0 / kMostWeight, kMostWeight));
  }
  int order = first ? kLeastOrder : state.spline.nurbs->order;
  if (words.has('L')) {
    const auto given = whole(state, words, 'L', kLeastOrder, kMostOrder);
    if (!given) return given.error();
    order = *given;
  }
  const double weight = words.has('P') ? words['P'].value : 1.0;
  if (first)
    state.spline.nurbs = SplineInProgress::Nurbs{
        state.at_work.block->place_of(movement.column), order, {{place_in_plane(state), weight}}};
  state.spline.nurbs->order = order;
  if (first && !words.has('X') && !words.has('Y')) return Done{};
  if (!words.has('X') || !words.has('Y')) {
    return fail(state, movement.column, "spline-word-missing"_id, "a control point without X and Y",
                "give both");
  }
  if (!first && !words.has('P')) {
    return fail(state, movement.column, "spline-word-missing"_id,
                "a control point without a weight",
                "give P above zero in each block of the spline, P1 for all alike");
  }
  // Steps count from the start of the spline.
  state.position.set(AxisLetter::X, state.spline.nurbs->points.front().place.x());
  state.position.set(AxisLetter::Y, state.spline.nurbs->points.front().place.y());
  if (auto done = set_targets(state, words); !done) return done;
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
    default:
      return move_along_nurbs(state, words, movement);
  }
}

Outcome check_open_nurbs(const InterpreterState& state, const Movement& movement) {
  const bool moves = movement.motion != MotionMode::none && movement.motion != MotionMode::nurbs &&
                     movement.motion != MotionMode::nurbs_end;
  const bool places = movement.non_modal != NonModal::none && movement.non_modal != NonModal::dwell;
  if (!state.spline.nurbs || (!moves && !places)) return Done{};
  return fail(state, movement.column, "spline-open"_id,
              fmt::format("a move between the points of the spline that G5.2 began on line {}",
                          state.spline.nurbs->place.line),
              "end the spline with G5.3 before");
}

std::optional<Diagnostic> spline_without_end(const InterpreterState& state) {
  if (!state.spline.nurbs) return std::nullopt;
  Diagnostic failure =
      error("spline-open"_id, "the spline that G5.2 begins has no G5.3", "end it with G5.3");
  failure.line = static_cast<int>(state.spline.nurbs->place.line);
  failure.column = static_cast<int>(state.spline.nurbs->place.column);
  return failure;
}

}  // namespace frustum::parser

// The splines of a program: G5, G5.1, and the points of G5.2 up to G5.3.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/moves/spline.hpp"

namespace frustum::parser {
namespace {

// A hundredth of a micrometre: a thousandth of what a machine of ISO 10791-7 shows.
constexpr double kTolerance = 1e-5;  // mm
constexpr int kLeastOrder = 3;
constexpr int kMostOrder = 30;
// Weights further apart leave no digits to the points between them.
constexpr double kMostWeight = 1e6;

}  // namespace

BlockExecutor::Outcome BlockExecutor::check_spline(const BlockWords& words,
                                                   const Movement& movement) const {
  if (state_.plane != Plane::xy) {
    return fail(movement.column, "spline-plane"_id, "a spline outside G17",
                "splines lie in the plane XY: G17");
  }
  if (const char letter = words.first_of(LetterSet("ZABC")); letter != 0) {
    return fail(words[letter].column, "spline-axes"_id,
                fmt::format("{} in a spline", words.text_of(letter)),
                "a spline moves X and Y only");
  }
  if (arc_waits_for_exit_) {
    return fail(movement.column, "radius-compensation"_id,
                "the first move after radius compensation is a spline",
                "leave the contour by a straight move");
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
    if (position_[axis]) continue;
    return fail(
        movement.column, position_.unknown_id(axis),
        fmt::format("the start of the spline is not known: {}", position_.why_unknown(axis)),
        "move to the start with G0 or G1 in G90 first");
  }
  if (auto done = check_tool_length(movement); !done) return done;
  return check_programmed_frame(movement);
}

BlockExecutor::Outcome BlockExecutor::move_along_spline(const BlockWords& words,
                                                        const Movement& movement) {
  if (auto done = check_spline(words, movement); !done) return done;
  switch (movement.motion) {
    case MotionMode::cubic_spline:
      return move_along_cubic(words, movement);
    case MotionMode::quadratic_spline:
      return move_along_quadratic(words, movement);
    case MotionMode::nurbs:
      return add_nurbs_point(words, movement);
    default:
      return move_along_nurbs(words, movement);
  }
}

Vec2 BlockExecutor::place_in_plane() const {
  return {*position_[AxisLetter::X], *position_[AxisLetter::Y]};
}

BlockExecutor::Outcome BlockExecutor::move_along_cubic(const BlockWords& words,
                                                       const Movement& movement) {
  const auto needs = [&](char given, std::string_view both, std::string_view what) {
    const std::uint32_t column = given != 0 ? words[given].column : movement.column;
    return fail(column, "spline-word-missing"_id, fmt::format("G5 without {}", both),
                std::string(what));
  };
  if (!words.has('P') || !words.has('Q')) {
    return needs(words.first_of(LetterSet("PQ")), "P and Q",
                 "P and Q lead from the end to the second control point");
  }
  const bool has_first = words.has('I') && words.has('J');
  if (!has_first && (words.has('I') || words.has('J') || !spline_leads_)) {
    return needs(words.first_of(LetterSet("IJ")), "I and J",
                 "I and J lead from the start to the first control point; both may be left out "
                 "behind another G5");
  }
  const double scale = unit_scale();
  const Vec2 first = has_first ? Vec2(words['I'].value, words['J'].value) * scale : *spline_leads_;
  const Vec2 second = Vec2(words['P'].value, words['Q'].value) * scale;
  const Vec2 start = place_in_plane();
  if (auto done = set_targets(words); !done) return done;
  const Vec2 end = place_in_plane();
  spline_leads_ = -second;
  const std::array points{ControlPoint{start}, ControlPoint{start + first},
                          ControlPoint{end + second}, ControlPoint{end}};
  return trace_spline(words, movement, points, static_cast<int>(points.size()));
}

BlockExecutor::Outcome BlockExecutor::move_along_quadratic(const BlockWords& words,
                                                           const Movement& movement) {
  if (!words.has('I') || !words.has('J')) {
    const char given = words.first_of(LetterSet("IJ"));
    return fail(given != 0 ? words[given].column : movement.column, "spline-word-missing"_id,
                "G5.1 without I and J",
                "I and J lead from the start to the control point; give both");
  }
  const Vec2 start = place_in_plane();
  const Vec2 middle = start + Vec2(words['I'].value, words['J'].value) * unit_scale();
  if (auto done = set_targets(words); !done) return done;
  const std::array points{ControlPoint{start}, ControlPoint{middle},
                          ControlPoint{place_in_plane()}};
  return trace_spline(words, movement, points, static_cast<int>(points.size()));
}

BlockExecutor::Outcome BlockExecutor::add_nurbs_point(const BlockWords& words,
                                                      const Movement& movement) {
  const bool first = !nurbs_;
  if (words.has('P') &&
      !(words['P'].value >= 1.0 / kMostWeight && words['P'].value <= kMostWeight)) {
    return fail(words['P'].column, "out-of-range"_id,
                fmt::format("the weight {} is out of range", words.text_of('P')),
                fmt::format("weights go from {:g} to {:g}", 1.0 / kMostWeight, kMostWeight));
  }
  int order = first ? kLeastOrder : nurbs_->order;
  if (words.has('L')) {
    const auto given = whole(words, 'L', kLeastOrder, kMostOrder);
    if (!given) return given.error();
    order = *given;
  }
  const double weight = words.has('P') ? words['P'].value : 1.0;
  if (first) nurbs_ = Nurbs{block_->place_of(movement.column), order, {{place_in_plane(), weight}}};
  nurbs_->order = order;
  if (first && !words.has('X') && !words.has('Y')) return Done{};
  if (!words.has('X') || !words.has('Y')) {
    return fail(movement.column, "spline-word-missing"_id, "a control point without X and Y",
                "give both");
  }
  if (!first && !words.has('P')) {
    return fail(movement.column, "spline-word-missing"_id, "a control point without a weight",
                "give P above zero in each block of the spline, P1 for all alike");
  }
  // Steps count from the start of the spline.
  position_.set(AxisLetter::X, nurbs_->points.front().place.x());
  position_.set(AxisLetter::Y, nurbs_->points.front().place.y());
  if (auto done = set_targets(words); !done) return done;
  nurbs_->points.push_back({place_in_plane(), weight});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::move_along_nurbs(const BlockWords& words,
                                                       const Movement& movement) {
  state_.motion = MotionMode::none;
  if (!nurbs_) {
    return fail(movement.column, "spline-not-begun"_id, "G5.3 without G5.2",
                "begin the spline with G5.2 and its control points");
  }
  const Nurbs nurbs = *std::exchange(nurbs_, std::nullopt);
  if (static_cast<int>(nurbs.points.size()) < nurbs.order) {
    return fail(
        movement.column, "spline-points"_id,
        fmt::format("{} control points for a spline of order {}", nurbs.points.size(), nurbs.order),
        "give at least as many points as its order L; the first is where the tool stands");
  }
  return trace_spline(words, movement, nurbs.points, nurbs.order);
}

BlockExecutor::Outcome BlockExecutor::trace_spline(const BlockWords& words,
                                                   const Movement& movement,
                                                   std::span<const ControlPoint> points,
                                                   int order) {
  const auto feed = feed_for(words, movement, true);
  if (!feed) return feed.error();
  const std::vector<PathPiece> pieces = arcs_of_spline(points, order, kTolerance);
  emit(movement.column, Event{"spline", fmt::format("{} control points, {} moves within {:g} mm",
                                                    points.size(), pieces.size(), kTolerance)});
  double length = 0.0;
  for (const PathPiece& piece : pieces) length += length_of(piece);
  AxisTarget end = end_of(words);
  const double height = position_[AxisLetter::Z].value_or(0.0);
  for (const PathPiece& piece : pieces) {
    end[AxisLetter::X] = piece.end.x();
    end[AxisLetter::Y] = piece.end.y();
    Feed share = *feed;
    if (share.mode == FeedMode::inverse_time) share.value *= length / length_of(piece);
    if (piece.is_arc()) {
      emit(movement.column, ArcFeed{end, Vec3(piece.centre.x(), piece.centre.y(), height),
                                    Plane::xy, piece.turns, state_.tool_axis, share});
    } else {
      emit(movement.column, LinearFeed{end, state_.tool_axis, Coordinates::program, share});
    }
  }
  return Done{};
}

// Between G5.2 and G5.3 are control points, and what moves nothing.
BlockExecutor::Outcome BlockExecutor::check_open_nurbs(const Movement& movement) const {
  const bool moves = movement.motion != MotionMode::none && movement.motion != MotionMode::nurbs &&
                     movement.motion != MotionMode::nurbs_end;
  const bool places = movement.non_modal != NonModal::none && movement.non_modal != NonModal::dwell;
  if (!nurbs_ || (!moves && !places)) return Done{};
  return fail(movement.column, "spline-open"_id,
              fmt::format("a move between the points of the spline that G5.2 began on line {}",
                          nurbs_->place.line),
              "end the spline with G5.3 before");
}

std::optional<Diagnostic> BlockExecutor::spline_without_end() const {
  if (!nurbs_) return std::nullopt;
  Diagnostic failure =
      error("spline-open"_id, "the spline that G5.2 begins has no G5.3", "end it with G5.3");
  failure.line = static_cast<int>(nurbs_->place.line);
  failure.column = static_cast<int>(nurbs_->place.column);
  return failure;
}

}  // namespace frustum::parser

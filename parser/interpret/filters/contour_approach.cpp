#include "parser/interpret/filters/contour_approach.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <variant>

namespace frustum::parser {
namespace {

using enum AxisLetter;

constexpr double kNoLink = 1e-9;  // mm

Diagnostic complaint_of(const Approach& approach, std::string message, std::string hint) {
  Diagnostic diagnostic = error("contour-approach"_id, std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(approach.place.line);
  diagnostic.column = static_cast<int>(approach.place.column);
  return diagnostic;
}

Vec2 turned(const Vec2& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle),
          v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

// Where a line from `place` touches the circle; `turn` 1: a point that goes round counterclockwise
// leads on from the line, -1: clockwise. `outward`: the line goes from the circle to `place`.
std::optional<Vec2> tangent_point(const Vec2& centre, double radius, const Vec2& place, double turn,
                                  bool outward) {
  const Vec2 arm = place - centre;
  const double distance = arm.norm();
  if (!(distance >= radius)) return std::nullopt;
  const double angle = std::acos(radius / distance) * turn * (outward ? -1.0 : 1.0);
  return centre + radius * turned(arm / distance, angle);
}

// The move of a command in the plane of X and Y, from where the contour begins.
std::optional<PathPiece> piece_from(const Vec2& start, const Command& command) {
  if (const auto* line = std::get_if<LinearFeed>(&command)) {
    if (line->coordinates == Coordinates::machine || !line->end[X] || !line->end[Y]) return {};
    const PathPiece piece{start, Vec2(*line->end[X], *line->end[Y])};
    return length_of(piece) > kNoLink ? std::optional(piece) : std::nullopt;
  }
  if (const auto* rapid = std::get_if<Traverse>(&command)) {
    if (rapid->coordinates == Coordinates::machine || !rapid->end[X] || !rapid->end[Y]) return {};
    const PathPiece piece{start, Vec2(*rapid->end[X], *rapid->end[Y])};
    return length_of(piece) > kNoLink ? std::optional(piece) : std::nullopt;
  }
  const auto* arc = std::get_if<ArcFeed>(&command);
  if (arc == nullptr || arc->plane != Plane::xy || !arc->end[X] || !arc->end[Y]) return {};
  PathPiece piece{start, Vec2(*arc->end[X], *arc->end[Y])};
  piece.centre = arc->center.head<2>();
  piece.turns = arc->turns;
  return piece;
}

AxisTarget* end_of_waiting(Command& command) {
  if (auto* line = std::get_if<LinearFeed>(&command)) return &line->end;
  if (auto* rapid = std::get_if<Traverse>(&command)) return &rapid->end;
  return nullptr;
}

// Of an arc that touches the contour: its centre, and which way round it goes.
struct Touching {
  Vec2 centre;
  double radius;
  double turn;
};
Touching touching(double size, const Vec2& contour, const Vec2& along, double side) {
  return {contour + side * size * left_of(along), std::abs(size), side * size > 0.0 ? 1.0 : -1.0};
}

}  // namespace

std::optional<std::vector<LinkMove>> moves_to_contour(const ContourLink& link, const Vec2& from,
                                                      const Vec2& contour, const Vec2& along,
                                                      double side) {
  std::vector<LinkMove> moves;
  const auto by_line = [&](const Vec2& begin) {
    moves.push_back({PathPiece{from, begin}, true});
    moves.push_back({PathPiece{begin, contour}, false});
    return moves;
  };
  switch (link.shape) {
    case ApproachWord::line_along:
    case ApproachWord::leave_along:
      return by_line(contour - link.size * along);
    case ApproachWord::line_across:
    case ApproachWord::leave_across:
      return by_line(contour + side * link.size * left_of(along));
    default:
      break;
  }
  const Touching arc = touching(link.size, contour, along, side);
  std::optional<Vec2> begin;
  if (link.shape == ApproachWord::arc) {
    begin = arc.centre + turned(contour - arc.centre, -arc.turn * link.angle);
  } else {
    begin = tangent_point(arc.centre, arc.radius, from, arc.turn, false);
  }
  if (!begin) return std::nullopt;
  moves.push_back({PathPiece{from, *begin}, true});
  PathPiece piece{*begin, contour};
  piece.centre = arc.centre;
  piece.turns = arc.turn > 0.0 ? 1 : -1;
  moves.push_back({piece, false});
  return moves;
}

std::optional<std::vector<LinkMove>> moves_from_contour(const ContourLink& link,
                                                        const Vec2& contour, const Vec2& along,
                                                        const Vec2& to, double side) {
  std::vector<LinkMove> moves;
  if (link.shape == ApproachWord::leave_along || link.shape == ApproachWord::leave_across) {
    const Vec2 direction =
        link.shape == ApproachWord::leave_along ? along : Vec2(side * left_of(along));
    moves.push_back({PathPiece{contour, contour + link.size * direction}, false});
    return moves;
  }
  const Touching arc = touching(link.size, contour, along, side);
  std::optional<Vec2> end;
  if (link.shape == ApproachWord::leave_by_arc) {
    end = arc.centre + turned(contour - arc.centre, arc.turn * link.angle);
  } else {
    end = tangent_point(arc.centre, arc.radius, to, arc.turn, true);
  }
  if (!end) return std::nullopt;
  PathPiece piece{contour, *end};
  piece.centre = arc.centre;
  piece.turns = arc.turn > 0.0 ? 1 : -1;
  moves.push_back({piece, false});
  if (link.shape == ApproachWord::leave_by_arc_and_line) {
    moves.push_back({PathPiece{*end, to}, false});
  }
  return moves;
}

void ContourApproach::give_up() {
  approach_.reset();
  waiting_.clear();
}

ContourApproach::Failure ContourApproach::take(Motion&& motion, const Sink& next,
                                               const Sink& beside, RadiusCompensation& radius) {
  if (std::holds_alternative<Traverse>(motion.command)) last_feed_.reset();
  if (const auto* line = std::get_if<LinearFeed>(&motion.command)) last_feed_ = line->feed;
  if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) last_feed_ = arc->feed;
  if (!approach_) {
    next(std::move(motion));
    return std::nullopt;
  }
  const auto& contour = approach_->contour;
  const auto piece = piece_from(Vec2(*contour[X], *contour[Y]), motion.command);
  const bool may_wait = !piece && (std::holds_alternative<Event>(motion.command) ||
                                   std::holds_alternative<SpindleChange>(motion.command) ||
                                   std::holds_alternative<CoolantChange>(motion.command) ||
                                   std::holds_alternative<Dwell>(motion.command) ||
                                   end_of_waiting(motion.command) != nullptr);
  if (may_wait) {
    waiting_.push_back(std::move(motion));
    return std::nullopt;
  }
  if (!piece) {
    const Approach given_up = *approach_;
    give_up();
    next(std::move(motion));
    return complaint_of(given_up, given_up.name + " before no contour in the plane",
                        "write the moves of the contour in X and Y after it");
  }
  if (auto failure = arrive(direction_at_start(*piece), beside, radius)) {
    give_up();
    return failure;
  }
  arrived_ = approach_->contour;
  give_up();
  next(std::move(motion));
  return std::nullopt;
}

ContourApproach::Failure ContourApproach::arrive(const Vec2& along, const Sink& beside,
                                                 RadiusCompensation& radius) {
  const Approach& to = *approach_;
  const Vec2 programmed(*to.contour[X], *to.contour[Y]);
  const Vec2 from(*to.from[X], *to.from[Y]);
  const double here = left_of(along).dot(from - programmed);
  const double side =
      to.side ? (*to.side == ToolSide::left ? 1.0 : -1.0) : (here < 0.0 ? -1.0 : 1.0);
  const Vec2 contour = programmed + side * to.radius * left_of(along);
  const auto moves = moves_to_contour(to.link, from, contour, along, side);
  if (!moves) {
    return complaint_of(
        to, fmt::format("{} begins within the circle of its arc", to.name),
        "begin further away, or give a smaller radius: no line from there touches the arc");
  }
  AxisTarget at = to.from;
  const auto straight = [&](const std::optional<Feed>& feed) {
    if (feed) {
      beside({to.place, LinearFeed{at, to.tool_axis, Coordinates::program, *feed}});
    } else {
      beside({to.place, Traverse{at, to.tool_axis, Coordinates::program}});
    }
  };
  for (const LinkMove& move : *moves) {
    const bool none = !move.piece.is_arc() && length_of(move.piece) <= kNoLink;
    at[X] = move.piece.end.x();
    at[Y] = move.piece.end.y();
    const auto& feed = move.first_of_approach ? to.feed_before : to.feed;
    if (move.piece.is_arc() && feed) {
      const Vec3 centre(move.piece.centre.x(), move.piece.centre.y(), at[Z].value_or(0.0));
      beside({to.place, ArcFeed{at, centre, Plane::xy, move.piece.turns, to.tool_axis, *feed}});
    } else if (!none) {
      straight(feed);
    }
    if (!move.first_of_approach) continue;
    // Then down, and the axes that turn.
    bool moves_more = false;
    for (const AxisLetter axis : {Z, A, B, C}) {
      if (!to.contour[axis] || to.contour[axis] == at[axis]) continue;
      at[axis] = to.contour[axis];
      moves_more = true;
    }
    if (moves_more) straight(feed);
  }
  for (Motion& motion : waiting_) {
    if (AxisTarget* end = end_of_waiting(motion.command)) {
      (*end)[X] = contour.x();
      (*end)[Y] = contour.y();
    }
    beside(std::move(motion));
  }
  waiting_.clear();
  if (to.compensation) radius.start(*to.compensation, to.contour, true);
  return std::nullopt;
}

}  // namespace frustum::parser

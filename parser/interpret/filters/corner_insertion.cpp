#include "parser/interpret/filters/corner_insertion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace frustum::parser {
namespace {

constexpr double kStraight = 1e-6;        // sine of the angle between two moves that have no corner
constexpr double kCornerRounding = 1e-9;  // mm

Diagnostic complaint(const SourcePlace& place, DiagnosticId id, std::string message,
                     std::string hint) {
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return diagnostic;
}

const AxisTarget* end_of(const Command& command) {
  if (const auto* rapid = std::get_if<Traverse>(&command)) return &rapid->end;
  if (const auto* feed = std::get_if<LinearFeed>(&command)) return &feed->end;
  if (const auto* arc = std::get_if<ArcFeed>(&command)) return &arc->end;
  return nullptr;
}
Feed* feed_of_line(Command& command) {
  if (auto* feed = std::get_if<LinearFeed>(&command)) return &feed->feed;
  if (auto* arc = std::get_if<ArcFeed>(&command)) return &arc->feed;
  return nullptr;
}
AxisTarget& moved_end(Command& command) {
  auto* feed = std::get_if<LinearFeed>(&command);
  return feed != nullptr ? feed->end : std::get<ArcFeed>(command).end;
}
bool cuts_nothing(const Command& command) {
  return std::holds_alternative<Event>(command) || std::holds_alternative<SpindleChange>(command) ||
         std::holds_alternative<CoolantChange>(command);
}

// Of a line or circle, the point next to `point`.
Vec2 foot_on(const PathPiece& piece, const Vec2& point) {
  if (piece.is_arc()) {
    return piece.centre + radius_of(piece) * (point - piece.centre).normalized();
  }
  const Vec2 along = direction_at_start(piece);
  return piece.start + along * along.dot(point - piece.start);
}

}  // namespace

void CornerInsertion::begin(const AxisTarget& reached, Plane plane) {
  reached_ = reached;
  plane_ = plane;
}

std::optional<PathPiece> CornerInsertion::piece_of(const Command& command) const {
  const auto* line = std::get_if<LinearFeed>(&command);
  const auto* arc = std::get_if<ArcFeed>(&command);
  if (line == nullptr && arc == nullptr) return std::nullopt;
  if (line != nullptr && line->coordinates == Coordinates::machine) return std::nullopt;
  if (arc != nullptr && arc->plane != plane_) return std::nullopt;
  const AxisTarget& end = line != nullptr ? line->end : arc->end;
  for (const AxisLetter axis : kAxisLetters) {
    if (axis != u() && axis != v() && end[axis] && end[axis] != reached_[axis]) return std::nullopt;
  }
  if (!reached_[u()] || !reached_[v()] || !end[u()] || !end[v()]) return std::nullopt;
  PathPiece piece{Vec2(*reached_[u()], *reached_[v()]), Vec2(*end[u()], *end[v()])};
  if (arc != nullptr) {
    if (std::abs(arc->turns) != 1) return std::nullopt;
    const PlaneAxes axes = axes_of(plane_);
    piece.centre = Vec2(arc->center[axes.u], arc->center[axes.v]);
    piece.turns = arc->turns;
  } else if ((piece.end - piece.start).norm() < kCornerRounding) {
    return std::nullopt;
  }
  return piece;
}

CornerInsertion::Failure CornerInsertion::insert(const Corner& corner) {
  if (corner_) {
    return complaint(corner.place, "corner-twice"_id,
                     fmt::format("{} after {}", corner.name, corner_->name),
                     "a corner is between two moves: write one of them");
  }
  if (!piece_ && corner.if_any) return std::nullopt;
  if (!piece_) {
    return complaint(corner.place, "corner-without-move"_id,
                     corner.name + " after no cutting move in the plane",
                     "write it right after an L or C block that moves in X and Y");
  }
  corner_ = corner;
  return std::nullopt;
}

void CornerInsertion::release(const Sink& sink) {
  corner_.reset();
  piece_.reset();
  for (Motion& motion : waiting_) sink(std::move(motion));
  waiting_.clear();
}

CornerInsertion::Failure CornerInsertion::take(Motion&& motion, const Sink& sink) {
  if (!waiting_.empty() && cuts_nothing(motion.command)) {
    waiting_.push_back(std::move(motion));
    return std::nullopt;
  }
  const AxisTarget* end = end_of(motion.command);
  auto piece = piece_of(motion.command);
  Failure failure;
  if (corner_ && !piece && corner_->if_any) {
    // The contour ends here.
  } else if (corner_ && !piece) {
    failure = complaint(corner_->place, "corner-without-move"_id,
                        corner_->name + " before no cutting move in the plane",
                        "write an L or C block after it that moves in X and Y alone");
  } else if (corner_) {
    failure = cut(motion, *piece, sink);
  }
  release(sink);
  if (failure) return failure;
  if (end == nullptr && !cuts_nothing(motion.command) &&
      !std::holds_alternative<Dwell>(motion.command)) {
    reached_ = {};
  }
  const auto* rapid = std::get_if<Traverse>(&motion.command);
  const auto* line = std::get_if<LinearFeed>(&motion.command);
  const bool of_machine = (rapid != nullptr && rapid->coordinates == Coordinates::machine) ||
                          (line != nullptr && line->coordinates == Coordinates::machine);
  if (of_machine) {
    reached_ = {};
  } else if (end != nullptr) {
    for (const AxisLetter axis : kAxisLetters) {
      if ((*end)[axis]) reached_[axis] = (*end)[axis];
    }
  }
  if (!piece) {
    sink(std::move(motion));
    return std::nullopt;
  }
  piece_ = piece;
  waiting_.push_back(std::move(motion));
  return std::nullopt;
}

// Shortens the move that waits, and puts the corner after it. The next move begins where the corner
// ends.
CornerInsertion::Failure CornerInsertion::cut(Motion& next, PathPiece& piece, const Sink& sink) {
  const Corner corner = *corner_;
  const PathPiece& before = *piece_;
  const auto fail = [&](DiagnosticId id, std::string message, std::string hint) {
    return complaint(corner.place, id, std::move(message), std::move(hint));
  };
  const double turn = signed_angle(direction_at_end(before), direction_at_start(piece));
  if (corner.if_any && std::abs(turn) < kStraight) return std::nullopt;
  if (std::abs(std::sin(turn)) < kStraight) {
    return fail("corner-none"_id,
                fmt::format("{} where the moves {}", corner.name,
                            std::cos(turn) > 0.0 ? "lead on without a corner" : "go straight back"),
                "leave it out there");
  }
  if (!corner.rounds && (before.is_arc() || piece.is_arc())) {
    return fail("corner-at-arc"_id, corner.name + " at an arc",
                "a chamfer is between two L blocks; round it by RND");
  }
  const double side = turn > 0.0 ? 1.0 : -1.0;
  const double lengths[] = {length_of(before), length_of(piece)};
  const double share = corner.across ? corner.size / (2.0 * std::cos(turn / 2.0)) : corner.size;
  double lost[] = {share, share};
  Vec2 begin = before.end - share * direction_at_end(before);
  Vec2 end = piece.start + share * direction_at_start(piece);
  Vec2 centre = Vec2::Zero();
  bool fits = true;
  if (corner.rounds) {
    fits = false;
    const bool room = curvature_of(before) * side * corner.size < 1.0 &&
                      curvature_of(piece) * side * corner.size < 1.0;
    double least = std::numeric_limits<double>::infinity();
    const auto found =
        room ? crossings(parallel(before, side * corner.size), parallel(piece, side * corner.size))
             : std::vector<Vec2>{};
    for (const Vec2& candidate : found) {
      const Vec2 first = foot_on(before, candidate);
      const Vec2 second = foot_on(piece, candidate);
      const double losses[] = {lost_at_end(before, first), lost_at_start(piece, second)};
      if (losses[0] < 0.0 || losses[1] < 0.0 || losses[0] + losses[1] > least) continue;
      least = losses[0] + losses[1];
      lost[0] = losses[0];
      lost[1] = losses[1];
      begin = first;
      end = second;
      centre = candidate;
      fits = true;
    }
  }
  for (const int move : {0, 1}) {
    if (fits && lost[move] <= lengths[move] + kCornerRounding) continue;
    return fail(
        "corner-too-large"_id,
        fits
            ? fmt::format("{} takes {:.6g} mm of the {:.6g} mm of the move {} it", corner.name,
                          lost[move], lengths[move], move == 0 ? "before" : "after")
            : fmt::format("{} of {:g} mm does not fit between its moves", corner.name, corner.size),
        "make it smaller");
  }
  Feed feed = *feed_of_line(waiting_.front().command);
  if (feed.mode == FeedMode::inverse_time ||
      feed_of_line(next.command)->mode == FeedMode::inverse_time) {
    return fail("corner-timed"_id, corner.name + " beside a move with FT",
                "give the moves at the corner a feed F");
  }
  if (corner.feed_of_next) feed = *feed_of_line(next.command);
  if (corner.feed) feed.value = *corner.feed;
  AxisTarget& shortened = moved_end(waiting_.front().command);
  shortened[u()] = begin.x();
  shortened[v()] = begin.y();
  AxisTarget target = reached_;
  target[u()] = end.x();
  target[v()] = end.y();
  const auto tool_axis = std::visit(
      [](const auto& command) -> std::optional<UnitVec3> {
        if constexpr (requires { command.tool_axis; }) return command.tool_axis;
        return std::nullopt;
      },
      waiting_.front().command);
  piece.start = end;
  Vec3 middle = Vec3::Zero();
  middle[axes_of(plane_).u] = centre.x();
  middle[axes_of(plane_).v] = centre.y();
  middle[axes_of(plane_).w] = target[w()].value_or(0.0);
  release(sink);
  if (corner.rounds) {
    sink(Motion{corner.place,
                ArcFeed{target, middle, plane_, side > 0.0 ? 1 : -1, tool_axis, feed}});
  } else {
    sink(Motion{corner.place, LinearFeed{target, tool_axis, Coordinates::program, feed}});
  }
  return std::nullopt;
}

}  // namespace frustum::parser

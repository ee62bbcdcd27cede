#include "parser/interpret/filters/radius_compensation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "core/constants.hpp"
#include "parser/arc.hpp"

namespace frustum::parser {
namespace {

// Shorter than any control's increment: not a move in the plane.
constexpr double kNoMove = 1e-9;  // mm
// What waits is held in memory; a program that says so much between two moves has lost its contour.
constexpr std::size_t kMaxWaiting = 10'000;

Diagnostic at(const Motion& motion, DiagnosticId id, std::string message, std::string hint) {
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(motion.place.line);
  diagnostic.column = static_cast<int>(motion.place.column);
  return diagnostic;
}

AxisTarget* target_of(Command& command) {
  if (auto* traverse = std::get_if<Traverse>(&command)) return &traverse->end;
  if (auto* feed = std::get_if<LinearFeed>(&command)) return &feed->end;
  if (auto* arc = std::get_if<ArcFeed>(&command)) return &arc->end;
  return nullptr;
}

Feed* feed_of_contour(Command& command) {
  if (auto* feed = std::get_if<LinearFeed>(&command)) return &feed->feed;
  if (auto* arc = std::get_if<ArcFeed>(&command)) return &arc->feed;
  return nullptr;
}

constexpr const char* kSmallerTool = "use a smaller tool, or give the corner more room";

}  // namespace

double RadiusCompensation::left() const {
  return setting_->side == ToolSide::left ? setting_->radius : -setting_->radius;
}

std::optional<Vec2> RadiusCompensation::plane_point(const AxisTarget& target) const {
  const PlaneAxes axes = axes_of(setting_->plane);
  const auto& u = target[static_cast<AxisLetter>(axes.u)];
  const auto& v = target[static_cast<AxisLetter>(axes.v)];
  if (!u || !v) return std::nullopt;
  return Vec2(*u, *v);
}

void RadiusCompensation::set_plane_axes(AxisTarget& target, const Vec2& point) const {
  const PlaneAxes axes = axes_of(setting_->plane);
  target[static_cast<AxisLetter>(axes.u)] = point.x();
  target[static_cast<AxisLetter>(axes.v)] = point.y();
}

void RadiusCompensation::send(Motion&& motion, const Sink& sink) const {
  const PlaneAxes axes = axes_of(setting_->plane);
  if (AxisTarget* target = target_of(motion.command);
      target != nullptr && setting_->control != Vec2::Zero()) {
    if (const auto point = plane_point(*target))
      set_plane_axes(*target, *point + setting_->control);
    if (auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      arc->center[axes.u] += setting_->control.x();
      arc->center[axes.v] += setting_->control.y();
    }
  }
  sink(std::move(motion));
}

void RadiusCompensation::start(const RadiusSetting& setting, const AxisTarget& position,
                               bool beside_contour) {
  setting_ = setting;
  beside_contour_ = beside_contour;
  programmed_ = plane_point(position);
  reached_ = position;
}

std::optional<Vec2> RadiusCompensation::stop(const Sink& sink) {
  std::optional<Vec2> end;
  if (last_) {
    const bool has_direction = length_of(last_->programmed) > kNoMove;
    end = has_direction ? last_->beside.end : last_->programmed.end;
    release(*end, sink);
  }
  setting_.reset();
  return end;
}

RadiusCompensation::Failure RadiusCompensation::take(Motion&& motion, const Sink& sink) {
  AxisTarget* target = is_on() ? target_of(motion.command) : nullptr;
  const auto end = target != nullptr ? plane_point(*target) : std::nullopt;
  const bool moves = end && (!programmed_ || (*end - *programmed_).norm() > kNoMove ||
                             std::holds_alternative<ArcFeed>(motion.command));
  if (moves) {
    ++doubts_.moves;
    PathPiece piece{programmed_.value_or(*end), *end};
    if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      const PlaneAxes axes = axes_of(setting_->plane);
      piece.centre = {arc->center[axes.u], arc->center[axes.v]};
      piece.turns = arc->turns;
    }
    if (last_) return follow(std::move(motion), piece, sink);
    return beside_contour_ ? go_on_beside(std::move(motion), piece)
                           : enter(std::move(motion), piece, sink);
  }
  if (target != nullptr && setting_->rules.entry_comes_first && !last_) {
    return at(motion, "radius-compensation"_id,
              "the first move with radius compensation does not go along the plane",
              "enter the contour by a straight move in the plane, longer than the tool's radius");
  }
  if (target != nullptr) reached_ = *target;
  if (!last_) {
    sink(std::move(motion));
    return std::nullopt;
  }
  if (waiting_.size() >= kMaxWaiting) {
    return at(motion, "radius-compensation"_id,
              fmt::format("{} motions and events without a move in the plane of the radius "
                          "compensation",
                          waiting_.size()),
              "switch it off with G40, or go on along the contour");
  }
  waiting_.push_back(std::move(motion));
  return std::nullopt;
}

RadiusCompensation::Failure RadiusCompensation::enter(Motion&& motion, const PathPiece& piece,
                                                      const Sink& sink) {
  const RadiusRules& rules = setting_->rules;
  if (piece.is_arc() && !rules.entry_may_be_arc) {
    return at(motion, "radius-compensation"_id, "the first move with radius compensation is an arc",
              "enter the contour by a straight move, longer than the tool's radius");
  }
  if (!programmed_ && rules.entry == EntryRule::beside_its_end) {
    return at(motion, "radius-compensation"_id, "the start of the entry move is not known",
              "move to it with G0 or G1 in absolute coordinates before G41 or G42");
  }
  const double distance = (piece.end - piece.start).norm();
  if (programmed_ && distance <= setting_->radius) {
    return at(motion, "radius-compensation"_id,
              fmt::format("the entry move goes {:.6g} mm, which is not more than the tool's radius "
                          "of {:.6g} mm",
                          distance, setting_->radius),
              "begin the entry further away, or use a smaller tool");
  }
  if (piece.is_arc()) return enter_by_arc(std::move(motion), piece, sink);
  LastMove move{piece, piece, piece.start, 0.0, true};
  if (programmed_) move.beside = parallel(piece, left());
  wait(std::move(motion), std::move(move));
  return std::nullopt;
}

RadiusCompensation::Failure RadiusCompensation::go_on_beside(Motion&& motion,
                                                             const PathPiece& piece) {
  if (auto failure = check_arc(piece, motion)) return failure;
  LastMove move{piece, parallel(piece, left()), {}, 0.0, false};
  move.start = move.beside.start;
  wait(std::move(motion), std::move(move));
  return std::nullopt;
}

// From where it starts, tangent to the parallel at its end.
RadiusCompensation::Failure RadiusCompensation::enter_by_arc(Motion&& motion,
                                                             const PathPiece& piece,
                                                             const Sink& sink) {
  if (auto failure = check_arc(piece, motion)) return failure;
  PathPiece entry = piece;
  entry.end = parallel(piece, left()).end;
  const Vec2 inward = (piece.centre - piece.end).normalized();
  const Vec2 chord = entry.end - entry.start;
  const double across = -inward.dot(chord);
  if (across <= kNoMove) {
    return at(motion, "radius-compensation"_id,
              "no arc leads from the start of the entry to the path beside its end",
              "enter the contour by a straight move, longer than the tool's radius");
  }
  entry.centre = entry.end + inward * (chord.squaredNorm() / (2.0 * across));
  auto& arc = std::get<ArcFeed>(motion.command);
  const PlaneAxes axes = axes_of(setting_->plane);
  arc.center[axes.u] = entry.centre.x();
  arc.center[axes.v] = entry.centre.y();
  // The centre of the edge has to be where the arc begins.
  if (setting_->control != Vec2::Zero()) {
    AxisTarget start = reached_;
    set_plane_axes(start, entry.start);
    send({motion.place, LinearFeed{start, arc.tool_axis, Coordinates::program, arc.feed}}, sink);
  }
  wait(std::move(motion), {piece, entry, entry.start, 0.0, true});
  return std::nullopt;
}

RadiusCompensation::Failure RadiusCompensation::check_arc(const PathPiece& piece,
                                                          const Motion& motion) const {
  const bool inside = piece.is_arc() && (piece.turns > 0) == (left() > 0.0);
  const double radius = inside ? radius_of(piece) : 0.0;
  if (!inside || radius > setting_->radius) return std::nullopt;
  return at(motion, "radius-gouge"_id,
            fmt::format("the tool, of radius {:.6g} mm, is inside an arc of radius {:.6g} mm",
                        setting_->radius, radius),
            fmt::format("the arc's radius must be more than {:.6g} mm larger, or the tool smaller",
                        setting_->radius - radius));
}

RadiusCompensation::Failure RadiusCompensation::follow(Motion&& motion, const PathPiece& piece,
                                                       const Sink& sink) {
  if (auto failure = check_arc(piece, motion)) return failure;
  LastMove next{piece, parallel(piece, left()), {}, 0.0, false};
  next.start = next.beside.start;
  const double side = left() > 0.0 ? 1.0 : -1.0;
  const double angle =
      side * signed_angle(direction_at_end(last_->programmed), direction_at_start(piece));
  const double limit = setting_->rules.straight_below;
  if (last_->entry && setting_->rules.entry == EntryRule::beside_contour) {
    doubts_.outside_entry |= length_of(last_->programmed) > kNoMove && angle < -limit;
    release(next.start, sink);
    wait(std::move(motion), std::move(next));
    return std::nullopt;
  }
  // Straight back, the room between the two is the tool's when they bend apart on its side.
  const bool concave =
      std::numbers::pi - std::abs(angle) < limit
          ? side * (curvature_of(last_->programmed) + curvature_of(piece)) < -kNoMove
          : angle > 0.0;
  if (setting_->radius == 0.0) {
    release(next.start, sink);
  } else if (std::abs(angle) <= limit) {
    next.start = last_->beside.end;
    release(next.start, sink);
  } else if (concave) {
    if (auto failure = cut_corner(next, motion)) return failure;
    release(next.start, sink);
  } else {
    doubts_.outside_corner = true;
    const Vec2 from = last_->beside.end;
    release(from, sink);
    const PathPiece corner{from, next.start, piece.start, left() > 0.0 ? -1 : 1};
    go_round_corner(motion, corner, length_of(next.beside), sink);
  }
  wait(std::move(motion), std::move(next));
  return std::nullopt;
}

void RadiusCompensation::go_round_corner(Motion& motion, const PathPiece& corner,
                                         double move_length, const Sink& sink) {
  AxisTarget end = reached_;
  set_plane_axes(end, corner.end);
  if (const auto* traverse = std::get_if<Traverse>(&motion.command)) {
    send({motion.place, Traverse{end, traverse->tool_axis, traverse->coordinates}}, sink);
    return;
  }
  Feed& feed = *feed_of_contour(motion.command);
  ArcFeed arc{end, Vec3::Zero(), setting_->plane, corner.turns, std::nullopt, feed};
  if (feed.mode == FeedMode::inverse_time) {
    // The block takes 1/F minutes: its parts share them by their lengths.
    const double total = length_of(corner) + move_length;
    arc.feed.value *= total / length_of(corner);
    feed.value *= total / move_length;
  }
  const PlaneAxes axes = axes_of(setting_->plane);
  arc.center[axes.u] = corner.centre.x();
  arc.center[axes.v] = corner.centre.y();
  send({motion.place, arc}, sink);
}

RadiusCompensation::Failure RadiusCompensation::cut_corner(LastMove& next, const Motion& motion) {
  const double radius = setting_->radius;
  // An entry has as much room as it needs: it comes from beyond the contour.
  const double room_before = last_->entry ? std::numeric_limits<double>::infinity()
                                          : length_of(last_->beside) - last_->lost;
  const double room_behind = length_of(next.beside);
  struct Choice {
    Vec2 point = Vec2::Zero();
    double lost_behind = 0.0;
    double before_too_short = std::numeric_limits<double>::infinity();
    double behind_too_short = std::numeric_limits<double>::infinity();
    double lost = 0.0;
    [[nodiscard]] double too_short() const {
      return std::max({before_too_short, behind_too_short, 0.0});
    }
  };
  std::optional<Choice> best;
  for (const Vec2& point : crossings(last_->beside, next.beside)) {
    const double before = lost_at_end(last_->beside, point);
    const double behind = lost_at_start(next.beside, point);
    const Choice choice{point, behind, before - room_before, behind - room_behind, before + behind};
    const bool better =
        !best || choice.too_short() < best->too_short() - kNoMove ||
        (choice.too_short() < best->too_short() + kNoMove && choice.lost < best->lost);
    if (before > -kNoMove && behind > -kNoMove && better) best = choice;
  }
  if (!best) {
    return at(motion, "radius-gouge"_id,
              fmt::format("the tool, of radius {:.6g} mm, does not fit into the corner: the paths "
                          "beside its two moves miss each other by {:.6g} mm",
                          radius, gap_between(last_->beside, next.beside)),
              kSmallerTool);
  }
  if (best->too_short() > kNoMove) {
    const bool before = best->before_too_short > best->behind_too_short;
    return at(motion, "radius-gouge"_id,
              fmt::format("the tool, of radius {:.6g} mm, does not fit into the corner: the move "
                          "{} it is {:.6g} mm too short",
                          radius, before ? "before" : "after", best->too_short()),
              kSmallerTool);
  }
  next.start = best->point;
  next.lost = best->lost_behind;
  return std::nullopt;
}

void RadiusCompensation::wait(Motion&& motion, LastMove&& move) {
  reached_ = *target_of(motion.command);
  programmed_ = move.programmed.end;
  last_ = std::move(move);
  waiting_.push_back(std::move(motion));
}

void RadiusCompensation::release(const Vec2& end, const Sink& sink) {
  for (Motion& motion : waiting_) {
    if (AxisTarget* target = target_of(motion.command)) set_plane_axes(*target, end);
  }
  if (auto* arc = std::get_if<ArcFeed>(&waiting_.front().command)) {
    const PathPiece whole = last_->beside;
    const double way = length_of(whole) - last_->lost - lost_at_end(whole, end);
    const double turns = way / (kTurn * radius_of(whole));
    if (way < kNoMove) {
      waiting_.front().command =
          LinearFeed{arc->end, arc->tool_axis, Coordinates::program, arc->feed};
    } else {
      // A whole turn is a turn, in spite of rounding.
      const int started = std::max(1, static_cast<int>(std::ceil(turns - kNoMove)));
      arc->turns = arc->turns > 0 ? started : -started;
    }
  }
  for (Motion& motion : waiting_) send(std::move(motion), sink);
  waiting_.clear();
  last_.reset();
}

}  // namespace frustum::parser

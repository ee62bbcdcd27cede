// Cutter radius compensation: the path of the tool's centre beside a programmed contour.
//
// Model    : a stage that the motions of a program pass. Straight and circular moves in the plane
//            are replaced by their parallels at the tool's radius; a convex corner is gone round by
//            an arc about it (a rapid move goes straight to where it begins), at a concave corner
//            both moves end where their parallels meet. The third axis goes as programmed. A move
//            waits until the next one in the plane tells where it ends; what comes between waits
//            with it, in order. Only neighbours are looked at: a pocket that narrows over several
//            moves is not noticed.
// Units    : mm; feeds stay those of the program, at the tool's centre. In inverse time a move and
//            the arc before it share the time of their block.
// Shape    : start(), any number of motions, stop(); the axes of the plane are known from the entry
//            move on
// Errors   : an entry that is an arc, or not longer than the radius; a concave arc or corner that
//            the tool does not fit into, with the amount; an entry of unknown start; too many
//            motions that wait
// Accuracy : 1e-9 mm between contour and path (tests/parser/interpret/radius_compensation_test.cpp)
// Source   : ISO 6983-1 (G40 to G42); the rules of entry and of nearly straight corners of
//            LinuxCNC, User manual, Cutter Compensation
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "core/diagnostic.hpp"
#include "parser/dialects/radius_rules.hpp"
#include "parser/interpret/moves/plane_path.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct RadiusSetting {
  ToolSide side = ToolSide::left;
  double radius = 0.0;  // of a point: the path is the contour
  Plane plane = Plane::xy;
  RadiusRules rules{};
  // The point that the axes place, from the centre of the edge: a lathe tool's corner.
  Vec2 control = Vec2::Zero();
};

// What a control decides by its settings on the way beside the contour.
struct ContourDoubts {
  std::uint64_t moves = 0;      // in the plane so far
  bool outside_corner = false;  // one was gone round
  bool outside_entry = false;   // the contour began behind one
};

class RadiusCompensation {
 public:
  using Sink = std::function<void(Motion&&)>;
  using Failure = std::optional<Diagnostic>;

  [[nodiscard]] bool is_on() const { return setting_.has_value(); }
  [[nodiscard]] const RadiusSetting& setting() const { return *setting_; }
  // A move in the plane waits for the next one.
  [[nodiscard]] bool waits() const { return last_.has_value(); }
  [[nodiscard]] const ContourDoubts& doubts() const { return doubts_; }

  // `position`: where the tool is, as far as it is known; with `beside_contour` where the contour
  // begins, whose first move needs no entry: the tool is abeam of it already.
  void start(const RadiusSetting& setting, const AxisTarget& position, bool beside_contour = false);
  // A motion of the program. On, what it and those before it give goes to the sink when it is
  // final.
  [[nodiscard]] Failure take(Motion&& motion, const Sink& sink);
  // All that waits goes to the sink. The place of the tool in the plane is that of its centre, if
  // known.
  std::optional<Vec2> stop(const Sink& sink);

 private:
  // The last move in the plane, which the next one may shorten. Its motion is at the front of what
  // waits.
  struct LastMove {
    PathPiece programmed{};
    PathPiece beside{};  // whole, before corners
    Vec2 start = Vec2::Zero();
    double lost = 0.0;  // mm of it, at the corner before
    bool entry = false;
  };

  [[nodiscard]] Failure enter(Motion&& motion, const PathPiece& piece, const Sink& sink);
  [[nodiscard]] Failure enter_by_arc(Motion&& motion, const PathPiece& piece, const Sink& sink);
  [[nodiscard]] Failure go_on_beside(Motion&& motion, const PathPiece& piece);
  [[nodiscard]] Failure follow(Motion&& motion, const PathPiece& piece, const Sink& sink);
  [[nodiscard]] Failure cut_corner(LastMove& next, const Motion& motion);
  [[nodiscard]] Failure check_arc(const PathPiece& piece, const Motion& motion) const;
  // `move_length`: of the move after the corner.
  void go_round_corner(Motion& motion, const PathPiece& corner, double move_length,
                       const Sink& sink);
  void wait(Motion&& motion, LastMove&& move);
  // What waits is final: the last move ends at `end`.
  void release(const Vec2& end, const Sink& sink);
  void set_plane_axes(AxisTarget& target, const Vec2& point) const;
  // The motion of the edge's centre as one of the control point.
  void send(Motion&& motion, const Sink& sink) const;
  [[nodiscard]] std::optional<Vec2> plane_point(const AxisTarget& target) const;
  [[nodiscard]] double left() const;  // mm, below zero: right

  std::optional<RadiusSetting> setting_{};
  bool beside_contour_ = false;
  std::optional<Vec2> programmed_{};  // where the program has got to
  AxisTarget reached_{};              // the last target, as programmed
  std::optional<LastMove> last_{};
  std::deque<Motion> waiting_{};
  ContourDoubts doubts_{};
};

}  // namespace frustum::parser

// Ways on to a contour and off it: APPR and DEP of Klartext.
//
// Model    : a stage that the motions of a program pass before corners and radius compensation. An
//            approach waits for the first move of the contour in the plane, which gives the
//            direction at its start; the tool's centre then goes from where it is to the place
//            abeam of that start, by a line along or across the contour, or by an arc that touches
//            it. Departures are the same in the other direction
// Units    : mm, rad
// Shape    : take() every motion; begin() an approach after the motions before it have gone out
// Errors   : what follows is no move in the plane; a line to an arc that begins within its circle
// Accuracy : 1e-9 mm
// Source   : Heidenhain TNC 640 (34059x-02) User's Manual, Contour approach and departure; TNC7
//            (81762x-16), APPR CT: the signs of R
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "parser/dialects/code.hpp"
#include "parser/interpret/filters/radius_compensation.hpp"
#include "parser/interpret/moves/plane_path.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// What the tool goes along between its own place and that abeam of the contour.
struct ContourLink {
  ApproachWord shape = ApproachWord::line_along;
  double size = 0.0;   // the length of the line, or the radius: below zero on the other side
  double angle = 0.0;  // of the arc, above zero
};

// A move of a way to or from a contour, in the plane.
struct LinkMove {
  PathPiece piece{};
  bool first_of_approach = false;  // to where the line or arc begins
};

// From `from` to `contour`, where the tool goes on in the direction `along`; `side` 1: the tool is
// left of the contour, -1: right of it. Both places are those of the tool's centre. Nothing where a
// tangent does not exist.
[[nodiscard]] std::optional<std::vector<LinkMove>> moves_to_contour(const ContourLink& link,
                                                                    const Vec2& from,
                                                                    const Vec2& contour,
                                                                    const Vec2& along, double side);
// From `contour` on; `to` is used by line_and_arc alone.
[[nodiscard]] std::optional<std::vector<LinkMove>> moves_from_contour(const ContourLink& link,
                                                                      const Vec2& contour,
                                                                      const Vec2& along,
                                                                      const Vec2& to, double side);

struct Approach {
  std::string name{};  // for messages
  ContourLink link{};
  std::optional<ToolSide> side{};  // absent: the one where the tool is
  double radius = 0.0;             // of the tool, where it is compensated
  AxisTarget from{};
  AxisTarget contour{};               // its first point, as programmed
  std::optional<Feed> feed_before{};  // absent: by rapid
  std::optional<Feed> feed{};
  std::optional<UnitVec3> tool_axis{};
  std::optional<RadiusSetting> compensation{};
  SourcePlace place{};
};

class ContourApproach {
 public:
  using Sink = std::function<void(Motion&&)>;
  using Failure = std::optional<Diagnostic>;

  [[nodiscard]] const std::optional<Approach>& approach() const { return approach_; }
  // Of the last move; absent after a rapid one.
  [[nodiscard]] const std::optional<Feed>& last_feed() const { return last_feed_; }
  void begin(const Approach& approach) { approach_ = approach; }
  void give_up();
  // Where the contour begins, once an approach has led there: the next motion goes on from it.
  [[nodiscard]] std::optional<AxisTarget> take_arrival() { return std::exchange(arrived_, {}); }
  // `beside` takes what needs no compensation any more, `next` the contour.
  [[nodiscard]] Failure take(Motion&& motion, const Sink& next, const Sink& beside,
                             RadiusCompensation& radius);

 private:
  [[nodiscard]] Failure arrive(const Vec2& along, const Sink& beside, RadiusCompensation& radius);

  std::optional<Approach> approach_{};
  std::vector<Motion> waiting_{};
  std::optional<Feed> last_feed_{};
  std::optional<AxisTarget> arrived_{};
};

}  // namespace frustum::parser

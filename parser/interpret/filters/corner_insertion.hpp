// Roundings and chamfers between two moves of a contour: RND and CHF of Klartext, RND= CHF= CHR= of
// Sinumerik.
//
// Model    : a stage that the motions of a program pass before radius compensation. A cutting move
//            in the plane waits until the next block tells whether its end is a corner to round or
//            to break. A rounding is the arc that touches both moves inside the corner; a chamfer
//            cuts the same length from both
// Units    : mm
// Shape    : begin(), then take() every motion; insert() after the first move; release() where no
//            corner follows
// Errors   : no cutting move in the plane on either side; moves that lead on without a corner, or
//            go straight back; a corner that takes more of a move than there is, with the amounts;
//            a chamfer at an arc
// Accuracy : 1e-9 mm
// Source   : Heidenhain conversational programming manual, path contours: RND and CHF; Siemens
//            840D programming manual Fundamentals 4.22, Chamfer, rounding
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/moves/plane_path.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct Corner {
  std::string name{};  // of its word, for messages
  bool rounds = false;
  double size = 0.0;             // the radius, or the length cut from each move
  bool across = false;           // the size of a chamfer is its own length
  bool if_any = false;           // none where the moves have no corner in the plane
  bool feed_of_next = false;     // without one of its own: of the move after it
  std::optional<double> feed{};  // of the corner alone
  SourcePlace place{};
};

class CornerInsertion {
 public:
  using Sink = std::function<void(Motion&&)>;
  using Failure = std::optional<Diagnostic>;

  // Motions come from now on, from where the tool is.
  void start(const AxisTarget& from) { reached_ = from; }
  // From where the tool is; corners are in that plane.
  void begin(const AxisTarget& reached, Plane plane);
  // Whether a corner waits for the move after it.
  [[nodiscard]] const std::optional<Corner>& corner() const { return corner_; }
  [[nodiscard]] Failure take(Motion&& motion, const Sink& sink);
  [[nodiscard]] Failure insert(const Corner& corner);
  // The move that waits is final; a corner is given up.
  void release(const Sink& sink);

 private:
  [[nodiscard]] AxisLetter u() const { return static_cast<AxisLetter>(axes_of(plane_).u); }
  [[nodiscard]] AxisLetter v() const { return static_cast<AxisLetter>(axes_of(plane_).v); }
  [[nodiscard]] AxisLetter w() const { return static_cast<AxisLetter>(axes_of(plane_).w); }
  // A cutting move in the plane alone; nothing for others.
  [[nodiscard]] std::optional<PathPiece> piece_of(const Command& command) const;
  // `piece` then begins after the corner.
  [[nodiscard]] Failure cut(Motion& next, PathPiece& piece, const Sink& sink);

  Plane plane_ = Plane::xy;
  AxisTarget reached_{};              // by the motions taken; absent where a motion lost it
  std::vector<Motion> waiting_{};     // the move first, then what cuts nothing
  std::optional<PathPiece> piece_{};  // of the move, when it is in the plane
  std::optional<Corner> corner_{};
};

}  // namespace frustum::parser

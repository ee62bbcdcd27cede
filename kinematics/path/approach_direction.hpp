// From which side each axis came to where it is: the memory behind direction-dependent errors.
//
// Model    : the play operator. While an axis moves in + its direction of approach rises by 2 |dq|
//            / s until it is +1, in - it falls to -1; s is the axis's lost_motion distance, 0 turns
//            the direction of approach at once. Before an axis first moves its direction of
//            approach is 0; an axis that stands keeps it
// Units    : mm, rad; u runs from 0 to 1 along a motion
// Errors   : none
// Accuracy : turning points to the last digit of the position; an axis that swings back within one
//            part is not seen
// Source   : backlash of ISO 230-2, read as play
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kinematics/model/axes.hpp"
#include "kinematics/model/geometric_errors.hpp"

namespace frustum::kinematics {

// mm or rad: what an axis has to move for that to be motion. A control resolves a nanometre, and a
// word of a program is rounded to it: under tool centre point control three of them, and the rotary
// words, move a linear axis by up to 2e-6 mm where it should stand.
[[nodiscard]] constexpr double least_motion(AxisLetter axis) {
  return is_rotary(axis) ? 1e-8 : 3e-6;
}

using AxisMotion = std::function<AxisPositions(double)>;

// Directions of approach along one motion. A value of its own: it keeps a copy of the motion only
// where an axis settles.
class ApproachProfile {
 public:
  // At a turning point: as the axes come to it.
  [[nodiscard]] AxisPositions at(double u) const { return approach_directions(u, false, nullptr); }
  // The same, where the caller knows motion(u).
  [[nodiscard]] AxisPositions at(double u, const AxisPositions& q) const {
    return approach_directions(u, false, &q);
  }
  // At a turning point: as the axes leave it.
  [[nodiscard]] AxisPositions after(double u) const {
    return approach_directions(u, true, nullptr);
  }
  // Where a direction of approach jumps, begins or ends to change: increasing, within [0, 1).
  [[nodiscard]] std::span<const double> turning_points() const { return turning_points_; }

 private:
  friend class ApproachTracker;
  // From u on: direction of approach + rate (q(u) - q), within -1 .. +1.
  struct Piece {
    double u = 0.0;
    double q = 0.0;
    double heading = 0.0;
    double rate = 0.0;  // 0: settled
  };
  struct Axis {
    AxisLetter letter = AxisLetter::X;
    std::vector<Piece> pieces{};
  };
  [[nodiscard]] AxisPositions approach_directions(double u, bool leaving,
                                                  const AxisPositions* q) const;

  AxisPositions before_{};
  std::vector<Axis> axes_{};  // those that turn
  std::vector<double> turning_points_{};
  AxisMotion motion_{};
};

class ApproachTracker {
 public:
  ApproachTracker() = default;
  // Follows the axes whose errors depend on the direction, and no others.
  explicit ApproachTracker(const GeometricErrors& errors);

  // False: approach_directions matter to no error, and follow() costs nothing.
  [[nodiscard]] bool follows_any() const;
  // Directions of approach along `motion`, looked at in `parts` equal parts; the tracker then is at
  // its end.
  [[nodiscard]] ApproachProfile follow(const AxisMotion& motion, int parts);
  // Where the axes are now.
  [[nodiscard]] const AxisPositions& heading() const { return heading_; }
  // How far the axis has gone in the direction that it came in; nothing before it was followed.
  [[nodiscard]] std::optional<double> furthest(AxisLetter axis) const {
    return furthest_.at(static_cast<std::size_t>(axis));
  }

 private:
  using OfAxes = std::array<std::optional<double>, kAxisLetters.size()>;
  OfAxes lost_motion_{};  // of followed axes
  OfAxes furthest_{};
  AxisPositions heading_{};
};

}  // namespace frustum::kinematics

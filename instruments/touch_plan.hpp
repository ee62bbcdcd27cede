// Which faces of three columns a touch-trigger probe touches, and where A and C stand meanwhile.
//
// Model    : three square columns on the table. Point 5 m + f of column m: face +X, -X, +Y, -Y
//            (f = 0 .. 3, in the middle, 30 below the top) and the middle of the top (f = 4). The
//            table is turned about x by 0, -30, -60, -90 deg and about z by 0, 60 .. 300 deg; the
//            axes take the positions that turn it so. All points are touched where both are zero,
//            fewer elsewhere: those that the stylus, which comes from +Z, reaches and that tell the
//            pose best
// Units    : mm, rad; frame: rotor of C, whose origin is where the axes A and C cross
// Shape    : 4 tilts by 6 turns, 219 touches
// Errors   : machine-unsuited: a machine that is no table A on whose rotor C turns about a crossing
//            axis
// Source   : Ibaraki, Iritani, Matsushita (touch-trigger calibration of A and C); columns and plan
//            are ours, with the number of touches that they print
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

struct TouchPoint {
  Vec3 place = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // outward
};
inline constexpr std::size_t kTouchPoints = 15;
[[nodiscard]] const std::array<TouchPoint, kTouchPoints>& touch_points();
// How far from the crossing of the axes a column reaches.
[[nodiscard]] double column_reach();
// mm along the normal: the ball comes from so far before the surface, and goes at most so far
// behind it.
inline constexpr double kTouchApproach = 10.0;

// One position of an axis, and the rotation by which it turns the table.
struct TablePosition {
  double axis = 0.0;  // rad, as programmed
  Mat3 rotation = Mat3::Identity();
};

struct PlannedTouch {
  std::size_t tilt = 0;   // of TouchPlan::tilts
  std::size_t turn = 0;   // of TouchPlan::turns
  std::size_t point = 0;  // of touch_points()
};

struct TouchPlan {
  std::vector<TablePosition> tilts{};   // of A; the first is zero
  std::vector<TablePosition> turns{};   // of C; the first is zero
  std::vector<PlannedTouch> touches{};  // pose by pose
  Vec3 table_offset = Vec3::Zero();     // of the table's frame in that of C

  // By which A and C turn the table at a touch.
  [[nodiscard]] Mat3 rotation(const PlannedTouch& touch) const {
    return tilts[touch.tilt].rotation * turns[touch.turn].rotation;
  }
};

[[nodiscard]] Result<TouchPlan> touch_plan(const kinematics::Machine& machine);

// "A = -30 deg, C = 120 deg", "point 6 (-X of column 2)", and both together.
[[nodiscard]] std::string position_text(const TouchPlan& plan, std::size_t tilt, std::size_t turn);
[[nodiscard]] std::string point_text(std::size_t point);
[[nodiscard]] std::string place_of(const TouchPlan& plan, const PlannedTouch& touch);

}  // namespace frustum::instruments

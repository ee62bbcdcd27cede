// The contact of the machine in the middle, from which those of the others are found.
//
// Model    : lane_contact.hpp, one machine at a time and without haste
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : 1e-10 mm for the piece given
// Source   : ours
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "cutter/body/body.hpp"
#include "kinematics/model/tool_pose.hpp"
#include "trials/population/lane_contact.hpp"

namespace frustum::trials {

// The face that the cutter has at this height above its tip; nothing where a ball of that radius
// does not rest on it as on a smooth surface: end faces, and corners narrower than the ball.
[[nodiscard]] std::optional<LaneFace> face_at(const cutter::Body& body, double height, double ball);

struct PointOffFace {
  double distance = 0.0;  // mm, of the face continued beyond its ends
  Vec3 out = Vec3::Zero();
  double height = 0.0, rho = 0.0;
};
[[nodiscard]] PointOffFace off_face(const LaneFace& face, const kinematics::ToolPose& pose,
                                    const Vec3& point);

// A line of approach: the ball's centre is `touching` + v `normal`.
struct CentreLine {
  Vec3 touching = Vec3::Zero(), normal = Vec3::UnitZ();
  double ball = 0.0;
};
// A piece of motion as a parabola through three poses.
struct PoseParabola {
  std::array<kinematics::ToolPose, 3> poses{};
  [[nodiscard]] kinematics::ToolPose at(double tau) const;
};
// The change of that distance with tau for a point that stays; `off`: at this tau.
[[nodiscard]] double rate_off_face(const LaneFace& face, const PoseParabola& piece, double tau,
                                   const Vec3& point, const PointOffFace& off);

struct PieceSolution {
  double travel = 0.0, tau = 0.0, bend = 0.0;
  PointOffFace centre{};  // of the ball
};
// The deepest that the piece lets the ball go, and when; nothing if it never meets the line.
[[nodiscard]] std::optional<PieceSolution> solve_piece(const LaneFace& face,
                                                       const PoseParabola& piece,
                                                       const CentreLine& line, double travel);

using PosesOfPiece = std::array<kinematics::ToolPose, 3>;

// Where the middle machine's contact is: the piece of motion, and how it was.
struct ContactOrigin {
  std::array<std::uint32_t, 3> node{};
  double tau = 0.0;
  kinematics::ToolPose pose{};
  Vec3 touched = Vec3::Zero();
};
// Where another machine's cutter carried that contact: `own` are its poses of the piece.
[[nodiscard]] Vec3 carried(const ContactOrigin& origin, const PosesOfPiece& own);

// Whether what is that close stays out of the way, of a machine at so much of its laws' limits,
// whose contact is `drift` from where it was carried and has something come nearer (mm).
[[nodiscard]] bool keeps_away(const Closeness& from, double scale, double drift, double nearer);

}  // namespace frustum::trials

// The contact of the machine in the middle, from which those of the others are found.
//
// Model    : lane_contact.hpp, one machine at a time and without haste
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : 1e-10 mm for the piece given
// Source   : ours
#pragma once

#include <array>
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
struct PieceSolution {
  double travel = 0.0, tau = 0.0, bend = 0.0;
  PointOffFace centre{};  // of the ball
};
// The deepest that the piece lets the ball go, and when; nothing if it never meets the line.
[[nodiscard]] std::optional<PieceSolution> solve_piece(const LaneFace& face,
                                                       const PoseParabola& piece,
                                                       const CentreLine& line, double travel);

}  // namespace frustum::trials

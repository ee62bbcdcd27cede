// The cut part, probed on the machine that cut it.
//
// Model    : each planned point p with normal n is approached along n at one of the given rotary
//            positions, the stylus along the tool; the linear axes are commanded by the nominal
//            chain, and the ball goes where the chain with errors takes it:
//              c(s) = tip with errors at the axes commanded for p + s n
//            It stops where it touches the part as it was cut; the reading s - r is how far out the
//            surface seems to be, since the control knows the commanded positions alone. A point
//            that is probed at the axis positions at which it was cut so reads what is programmed,
//            whatever the errors
// Units    : mm, rad; points and normals in the workpiece frame of the plan
// Shape    : a touch a planned point, in the order of features and points
// Errors   : point-unreachable: no pose from which the stylus, along the tool, comes to the
//            surface from without; axis-overtravel; touch-missed
// Accuracy : 1e-10 mm for the path that cut the part
// Source   : ours
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "instruments/probe_lobes.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "metrology/measurement.hpp"
#include "programs/test_piece.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

struct PartProbe {
  double tool_length = 0.0;      // from the gauge point to the centre of the ball
  Vec3 ball_off = Vec3::Zero();  // of the ball from the programmed tip, in the frame of the tool
  instruments::ProbeLobes lobes{};
};

struct PartTouch {
  std::size_t feature = 0;
  std::size_t section = 0;
  std::size_t pose = 0;  // of PartTouches::poses
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
};

struct PartTouches {
  std::vector<kinematics::AxisPositions> poses{};  // rotary axes
  std::vector<PartTouch> touches{};
  // Where X, Y and Z of a program are counted from: G54 of the piece, without a tool.
  kinematics::AxisPositions origin{};
  // Z, counted so, at which the ball is clear of the blank: at the poses, and while the rotary axes
  // turn anywhere between zero and them; and whether the machine has so much travel.
  double safe = 0.0, turning = 0.0;
  bool can_turn = true;
  double ball_radius = 0.0, clearance = 0.0, reach = 0.0;
};

// The rotary positions that bring Z of the workpiece along the tool; zero where none do.
[[nodiscard]] kinematics::AxisPositions upright_position(const kinematics::Machine& machine,
                                                         const programs::TestPiece& piece);

// Each point at the first of the poses from which it can be reached.
[[nodiscard]] Result<PartTouches> part_touches(const kinematics::Machine& machine,
                                               const programs::TestPiece& piece,
                                               std::span<const kinematics::AxisPositions> poses,
                                               const PartProbe& probe);

// The axes that bring the ball's centre to a place, by the nominal chain.
[[nodiscard]] kinematics::AxisPositions ball_at(const kinematics::Machine& machine,
                                                const programs::TestPiece& piece,
                                                const kinematics::AxisPositions& pose,
                                                double tool_length, const Vec3& centre);
// X, Y and Z of a program for such a place: counted from the origin, to the ball.
[[nodiscard]] Vec3 words_of(const kinematics::Machine& machine, const programs::TestPiece& piece,
                            const PartTouches& plan, const PartTouch& touch, const Vec3& centre);

struct PartReadings {
  std::vector<double> values{};
  // Where the axes are when the ball touches.
  std::vector<kinematics::AxisState> at{};
  Diagnostics warnings{};  // of a stylus that the part is in the way of
};
[[nodiscard]] Result<PartReadings> part_readings(const kinematics::Machine& machine,
                                                 const kinematics::GeometricErrors& errors,
                                                 const programs::TestPiece& piece,
                                                 const stock::Workpiece& part,
                                                 const PartTouches& plan, const PartProbe& probe);

// Where the control takes the ball's centre to be, for a reading.
[[nodiscard]] Vec3 centre_of(const PartTouches& plan, const PartTouch& touch, double reading);

// What the plan says of these readings.
[[nodiscard]] Result<metrology::Measurement> part_measurement(const programs::TestPiece& piece,
                                                              const PartTouches& plan,
                                                              std::span<const double> readings);

}  // namespace frustum::trials

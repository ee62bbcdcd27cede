#include "instruments/touch_test.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "instruments/approach.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

// A point of the artefact in the frame of the table, where it nominally is.
TouchPoint on_table(const TouchPlan& plan, const PlannedTouch& touch) {
  TouchPoint point = touch_points().at(touch.point);
  point.place -= plan.table_offset;
  return point;
}

AxisPositions turned(const TouchPlan& plan, const PlannedTouch& touch) {
  AxisPositions q;
  q[AxisLetter::A] = plan.tilts[touch.tilt].axis;
  q[AxisLetter::C] = plan.turns[touch.turn].axis;
  return q;
}

// The artefact as it is mounted.
TouchPoint mounted(TouchPoint point, const TouchPlan& plan, const TouchSetup& setup) {
  const Mat3 turn =
      rotation_z(setup.tilt.z()) * rotation_y(setup.tilt.y()) * rotation_x(setup.tilt.x());
  return {turn * (point.place + plan.table_offset) - plan.table_offset + setup.shift,
          turn * point.normal};
}

}  // namespace

Result<std::vector<TestPose>> touch_poses(const Machine& machine,
                                          const kinematics::GeometricErrors& errors,
                                          const TouchPlan& plan, const TouchProbe& probe) {
  std::vector<TestPose> stops;
  stops.reserve(2 * plan.touches.size());
  for (const PlannedTouch& touch : plan.touches) {
    const TouchPoint point = on_table(plan, touch);
    for (const double off : {kTouchApproach, 0.0}) {
      const Vec3 ball = point.place + (probe.ball_radius + off) * point.normal;
      const AxisPositions q = place_tip(machine, ball, probe.tool_length, turned(plan, touch));
      if (!within_travel(machine, q)) {
        return error("axis-overtravel"_id,
                     fmt::format("touch of {} cannot be reached: {}", place_of(plan, touch),
                                 fmt::join(travel_violations(machine, q), "; ")),
                     "check the tool length and the travel of the machine");
      }
      stops.push_back({.at = q, .spindle_ball = ball});
    }
  }
  const AxisPositions start = stops.empty() ? AxisPositions{} : stops.front().at.q;
  stops = with_approach(std::move(stops), start, errors);
  std::vector<TestPose> poses;
  poses.reserve(plan.touches.size());
  for (std::size_t i = 1; i < stops.size(); i += 2) poses.push_back(stops[i]);
  return poses;
}

Result<std::vector<double>> touch_readings(const Machine& machine,
                                           const kinematics::GeometricErrors& errors,
                                           const TouchPlan& plan,
                                           const std::vector<TestPose>& poses,
                                           const TouchProbe& probe, const TouchSetup& setup) {
  constexpr double kDone = 1e-11;  // mm: a few roundings of a coordinate
  constexpr int kMostSteps = 20;
  const kinematics::ForwardChain actual(machine, errors, probe.tool_length);
  std::vector<double> readings;
  readings.reserve(plan.touches.size());
  for (std::size_t i = 0; i < plan.touches.size(); ++i) {
    const PlannedTouch& touch = plan.touches[i];
    const TouchPoint nominal = on_table(plan, touch);
    const TouchPoint surface = mounted(nominal, plan, setup);
    // The ball goes in along the nominal normal: a step is the gap to the actual plane.
    const double slope = nominal.normal.dot(surface.normal);
    double s = probe.ball_radius;
    bool touched = false;
    for (int step = 0;
         step < kMostSteps && !touched && std::abs(s - probe.ball_radius) <= kTouchApproach;
         ++step) {
      kinematics::AxisState at = poses[i].at;
      at.q = place_tip(machine, nominal.place + s * nominal.normal, probe.tool_length,
                       turned(plan, touch));
      const Vec3 ball = actual.table_from_tool(at).point(setup.ball);
      const double gap = (ball - surface.place).dot(surface.normal) - probe.ball_radius;
      s -= gap / slope;
      touched = std::abs(gap) < kDone;
    }
    if (!touched || !(std::abs(s - probe.ball_radius) <= kTouchApproach)) {
      return error("touch-missed"_id,
                   fmt::format("touch of {}: no surface within {:g} mm of its nominal place",
                               place_of(plan, touch), kTouchApproach),
                   "check the errors and the set-up");
    }
    // The tool keeps its attitude: what it faces turns with the table.
    const Vec3 outward =
        nominal_pose(machine, poses[i].at.q, 0.0).rotation.transpose() * nominal.normal;
    readings.push_back(s - probe.ball_radius - pre_travel(probe.lobes, outward));
  }
  return readings;
}

}  // namespace frustum::instruments

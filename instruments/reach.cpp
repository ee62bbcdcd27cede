#include "instruments/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisPositions;

constexpr double kStep = 1.0 * kRadPerDeg;  // between the places of an arc that are looked at

Diagnostic beyond(const kinematics::Machine& machine, const AxisPositions& q,
                  const std::string& what, double parameter) {
  return error(
      "axis-overtravel"_id,
      fmt::format("the test cannot be run: at {} = {:.6g} deg: {}", what, parameter * kDegPerRad,
                  fmt::join(kinematics::travel_violations(machine, q), "; ")),
      "use a shorter bar, another place of the table ball or fewer angles");
}

}  // namespace

std::optional<Diagnostic> out_of_reach(const kinematics::Machine& machine, const MotionTest& test,
                                       const std::string& what) {
  for (const TestPose& pose : test.poses) {
    if (!within_travel(machine, pose.at.q)) {
      return beyond(machine, pose.at.q, what, pose.parameter);
    }
  }
  if (!test.motion.axes) return std::nullopt;
  // Between the samples, where they are few.
  const auto apart = [](const TestPose& a, const TestPose& b) {
    return std::abs(b.parameter - a.parameter) > kStep;
  };
  if (std::ranges::adjacent_find(test.poses, apart) == test.poses.end()) return std::nullopt;
  const auto [least, most] = std::ranges::minmax_element(test.poses, {}, &TestPose::parameter);
  if (least == test.poses.end()) return std::nullopt;
  const double from = least->parameter, to = most->parameter;
  for (int i = 1; from + i * kStep < to; ++i) {
    const double parameter = from + i * kStep;
    const AxisPositions q = test.motion.axes(parameter);
    if (!within_travel(machine, q)) return beyond(machine, q, what, parameter);
  }
  return std::nullopt;
}

std::optional<Diagnostic> beyond_stroke(const MotionTest& test, std::span<const double> readings,
                                        double stroke, const std::string& what) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (std::abs(readings[i]) <= stroke) continue;
    return error("stroke-exceeded"_id,
                 fmt::format("the bar reads {:.4g} mm at {} = {:.6g} deg, beyond its stroke of "
                             "{:g} mm",
                             readings[i], what, test.poses[i].parameter * kDegPerRad, stroke),
                 "check the errors, the set-up and the length of the bar");
  }
  return std::nullopt;
}

}  // namespace frustum::instruments
